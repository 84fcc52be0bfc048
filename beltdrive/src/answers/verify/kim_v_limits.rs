//! Kim (2009), the limits of the V-belt drive that the text states.

use super::drives::{Failure, kim_v};
use super::{Comparison, Criterion, Published, Section, computed};
use crate::input::Key;
use crate::{Limits, SolveOptions, limits};

const LARGEST: &str = "no limit of the drive: the thesis divides by the cosine of the inclination, which \
                       passes through zero at 7523.08 N, at the exit of the driver; the arc length is \
                       regular there, and the branch goes on to a limit point";
const SMALLEST: &str = "no limit of the drive: the direction of the slip is 0/0 where the belt hardly \
                        slips; normalised, the states go on to equal tensions";

pub(super) fn section(progress: &mut dyn FnMut(f64, &str)) -> Section {
    let coulomb = range("coulomb", &mut |share, _| {
        progress(0.5 * share, "Kim (2009), limits with Coulomb friction");
    });
    let epp = range("epp", &mut |share, _| {
        progress(0.5 + 0.5 * share, "Kim (2009), limits with EPP friction");
    });
    let row = |quantity, text, reason, expected, found: &Result<Limits, Failure>, largest| {
        let number = computed(found, |found| match largest {
            true => found.largest.value,
            false => found.smallest.value,
        });
        let criterion = Criterion::known(reason, expected, 1e-3);
        Comparison::new(quantity, "N", Published::new(text), criterion, number)
    };
    Section {
        title: "Text",
        comparisons: vec![
            row(
                "largest T_H, Coulomb friction",
                "7781.2",
                LARGEST,
                8221.0148,
                &coulomb,
                true,
            ),
            row(
                "largest T_H, EPP friction",
                "7781.2",
                LARGEST,
                8221.0148,
                &epp,
                true,
            ),
            row(
                "smallest T_H, Coulomb friction",
                "562",
                SMALLEST,
                100.0,
                &coulomb,
                false,
            ),
            row(
                "smallest T_H, EPP friction",
                "575",
                SMALLEST,
                100.0,
                &epp,
                false,
            ),
        ],
    }
}

/// Both ends of the tight tension with a friction law.
fn range(law: &str, progress: &mut dyn FnMut(f64, &str)) -> Result<Limits, Failure> {
    let drive = kim_v(law, 700.0)?;
    let key = Key::load(&drive);
    Ok(limits(&drive, &key, &SolveOptions::default(), progress)?)
}
