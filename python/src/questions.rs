//! What Python asks of a drive: the commands of the program.

use crate::answer::{Answer, units};
use crate::failure::{Failure, InputError};
use crate::stated::Stated;
use beltdrive::belt_loop::{self, Varied};
use beltdrive::input::{Argument, Diagnostic, DriveFile, FileKey, Measurements};
use beltdrive::page::{self, Made};
use beltdrive::quantity::{self, uncertainty as told};
use beltdrive::transient::{Ending, Until};
use beltdrive::{
    BranchEnd, MapAxis, ModesQuestion, RatingQuestion, SetupQuestion, calibrate as calibration,
    uncertainty,
};
use pyo3::exceptions::PyRuntimeWarning;
use pyo3::prelude::*;

/// The steady state.
#[pyfunction]
pub(crate) fn solve(py: Python<'_>, stated: Stated) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let solved = beltdrive::solve_any(&file.drive()?, options)?;
        Ok(quantity::solved::answer(&solved))
    })
}

/// Whether the drive holds in each load case.
#[pyfunction]
pub(crate) fn check(py: Python<'_>, stated: Stated, samples: Option<usize>) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let service = file.service()?;
        let samples = drawn(file, samples)?;
        let checked = beltdrive::check(&service, options, &mut |_, _| {})?;
        let spread = uncertainty::of_check(file, &checked, samples, options, &mut |_, _| {})?;
        let answer = quantity::check::answer(&checked);
        Ok(told::told_in(answer, &spread, &service.cases))
    })
}

/// The page of a check.
#[pyfunction]
pub(crate) fn report(
    py: Python<'_>,
    stated: Stated,
    samples: Option<usize>,
    units: &str,
    call: &str,
) -> PyResult<String> {
    let units = self::units(units)?;
    stated.ask(py, |file, options| {
        let service = file.service()?;
        let samples = drawn(file, samples)?;
        let checked = beltdrive::check(&service, options, &mut |_, _| {})?;
        let spread = uncertainty::of_check(file, &checked, samples, options, &mut |_, _| {})?;
        let made = Made {
            name: &stated.0,
            text: &stated.1,
            overrides: &stated.2,
            filled_in: file.filled_in(),
            command_line: call,
        };
        Ok(page::report(&checked, &spread, &made, units))
    })
}

/// How many samples are drawn; 0 for none.
fn drawn(file: &DriveFile, samples: Option<usize>) -> Result<usize, Failure> {
    let is_known = file.uncertainty()?.is_empty();
    match samples {
        None => Ok(0),
        Some(_) if is_known => Err(Failure::input(
            "the drive file has no [uncertainty], so that all samples are the same",
        )),
        Some(samples) if (2..=1_000_000).contains(&samples) => Ok(samples),
        Some(_) => Err(Failure::input("samples must be from 2 to 1000000")),
    }
}

/// How tight to set the drive up.
#[pyfunction]
pub(crate) fn tension(
    py: Python<'_>,
    stated: Stated,
    margin: Option<f64>,
    elongation: f64,
    moved: Option<String>,
    samples: Option<usize>,
) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let service = file.service()?;
        let samples = drawn(file, samples)?;
        let slip_margin = margin.or(service.requirements.smallest_slip_margin);
        let slip_margin = slip_margin.ok_or_else(|| {
            Failure::input(
                "no slip margin is asked for\nexpected: `margin=1.5`, or `smallest_slip_margin` in \
                 [requirements] of the drive file",
            )
        })?;
        if !(slip_margin >= 1.0 && slip_margin.is_finite()) {
            return Err(Failure::input("margin must be at least 1"));
        }
        if !(0.0..1.0).contains(&elongation) {
            return Err(Failure::input("elongation must be at least 0 and below 1"));
        }
        let moved = moved.as_ref().map(|value| {
            let option = "move";
            Argument { option, value }.pulley(&service.cases[0].drive)
        });
        let question = SetupQuestion {
            slip_margin,
            elongation,
            moved: moved.transpose()?,
        };
        let found = beltdrive::tension(&service, question, options, &mut |_, _| {})?;
        let spread = uncertainty::of_tension(file, &found, samples, options, &mut |_, _| {})?;
        let answer = quantity::tension::answer(&found);
        Ok(told::told_in(answer, &spread, &service.cases))
    })
}

/// The largest torque and power against speed.
#[pyfunction]
pub(crate) fn rating(
    py: Python<'_>,
    stated: Stated,
    start: Option<String>,
    stop: Option<String>,
    samples: Option<usize>,
) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let drive = file.drive()?;
        let samples = drawn(file, samples)?;
        let question = RatingQuestion {
            from: speed(file, "start", start.as_deref())?,
            to: speed(file, "stop", stop.as_deref())?,
        };
        let found = beltdrive::rating(&drive, question, options, &mut |_, _| {})?;
        let quiet = &mut |_: f64, _: &str| {};
        let spread = uncertainty::of_rating(file, &found, question, samples, options, quiet)?;
        let answer = quantity::rating::answer(&found);
        Ok(told::told_in(answer, &spread, &[]))
    })
}

/// A speed of the driver, rad/s, if it is given.
fn speed(file: &DriveFile, option: &str, value: Option<&str>) -> Result<Option<f64>, Diagnostic> {
    let speed = value.map(|value| Argument { option, value }.driver_speed(file));
    speed.transpose()
}

/// The vibrations of the running drive.
#[pyfunction]
pub(crate) fn modes(
    py: Python<'_>,
    stated: Stated,
    count: usize,
    start: Option<String>,
    stop: Option<String>,
) -> PyResult<Answer> {
    stated.answer(py, |file, _| {
        if !(1..=40).contains(&count) {
            return Err(Failure::input("count must be from 1 to 40"));
        }
        let simulation = file.motion()?;
        let [start, stop] = [("start", &start), ("stop", &stop)]
            .map(|(option, value)| speed(file, option, value.as_deref()));
        let (start, stop) = (start?, stop?);
        if start.is_some() && stop.is_none() {
            return Err(Failure::input("start is given without stop"));
        }
        let question = ModesQuestion::new(count, start, stop);
        let found = beltdrive::modes(&simulation, question, &mut |_, _| {})?;
        Ok(quantity::modes::answer(&found))
    })
}

/// The drive in time.
#[pyfunction]
pub(crate) fn simulate(
    py: Python<'_>,
    stated: Stated,
    until: Option<String>,
    at: Vec<String>,
) -> PyResult<Answer> {
    let mut interrupt = None;
    let answer = stated.answer(py, |file, _| {
        let option = "until";
        let until = until.as_deref().map(|value| Argument { option, value });
        let mut simulation = file.simulation(until)?;
        for value in &at {
            let option = "at";
            simulation.instants.push(Argument { option, value }.time()?);
        }
        // An interrupt from the keyboard ends the run after the step at hand.
        let mut goes_on = |_, _| {
            interrupt = Python::attach(|py| py.check_signals()).err();
            interrupt.is_none()
        };
        let history = beltdrive::simulate(&simulation, &mut goes_on);
        let history = history.map_err(|error| match file.of_simulation(&simulation, &error) {
            Some(placed) => Failure::from(placed),
            None => Failure::from(error),
        })?;
        match (history.ending, simulation.until) {
            (Ending::NotSteady, Until::Steady { latest }) => Err(Failure::Unsolved(
                format!("the drive is not steady at {latest} s"),
                "not steady",
            )),
            _ => Ok(quantity::transient::answer(&simulation.drive, &history)),
        }
    });
    match interrupt {
        Some(interrupt) => Err(interrupt),
        None => answer,
    }
}

/// The smallest and the largest load.
#[pyfunction]
pub(crate) fn limits(
    py: Python<'_>,
    stated: Stated,
    parameter: Option<String>,
) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let drive = file.drive()?;
        let option = "parameter";
        let argument = parameter.as_deref().map(|value| Argument { option, value });
        if drive.two_pulleys().is_some() {
            let key = match argument {
                Some(argument) => argument.key(&drive)?,
                None => beltdrive::input::Key::load(&drive),
            };
            let limits = beltdrive::limits(&drive, &key, options, &mut |_, _| {})?;
            return Ok(quantity::limits::answer(&limits));
        }
        let varied = match argument {
            Some(argument) => Varied::Key(file.key(argument)?),
            None => Varied::LoadFactor,
        };
        let limits = belt_loop::limits(file, &varied, options, &mut |_, _| {})?;
        Ok(quantity::loop_range::limits(&limits))
    })
}

/// A branch of steady states, or of limits.
#[pyfunction]
pub(crate) fn trace(
    py: Python<'_>,
    stated: Stated,
    parameter: &str,
    start: &str,
    stop: &str,
    curve: Option<String>,
) -> PyResult<Answer> {
    let mut early = None;
    let answer = stated.answer(py, |file, options| {
        let drive = file.drive()?;
        let option = "parameter";
        let parameter = Argument {
            option,
            value: parameter,
        };
        let second = curve.as_deref().map(|value| Argument {
            option: "curve",
            value,
        });
        let ends = [("start", start), ("stop", stop)];
        let ends = ends.map(|(option, value)| Argument { option, value });
        if second.is_some_and(|second| second.value == parameter.value) {
            return Err(Failure::input("parameter and curve are the same entry"));
        }
        let quiet = &mut |_: f64, _: &str| {};
        if drive.two_pulleys().is_none() {
            let key = file.key(parameter)?;
            let number = |end: Argument<'_>, key: &FileKey| end.number(key);
            let [from, to] = ends;
            let varied = Varied::Key(key.clone());
            return Ok(match second {
                None => {
                    let range = distinct([number(from, &key)?, number(to, &key)?])?;
                    let branch = belt_loop::trace(file, &varied, range, options, quiet)?;
                    quantity::loop_range::branch(&branch)
                }
                Some(second) => {
                    let second = file.key(second)?;
                    let range = distinct([number(from, &second)?, number(to, &second)?])?;
                    let curve =
                        belt_loop::limit_curve(file, &varied, &second, range, options, quiet)?;
                    quantity::loop_range::limit_curve(&curve)
                }
            });
        }
        let key = parameter.key(&drive)?;
        let [from, to] = ends;
        let (answer, end) = match second {
            None => {
                let range = [from.value(key, &drive, None)?, to.value(key, &drive, None)?];
                let branch = beltdrive::trace(&drive, &key, distinct(range)?, options, quiet)?;
                (quantity::branch::answer(&branch), branch.end)
            }
            Some(second) => {
                let second = second.key(&drive)?;
                let value = |end: Argument<'_>| end.value(second, &drive, Some(key));
                let range = distinct([value(from)?, value(to)?])?;
                let curve = beltdrive::limit_curve(&drive, &key, &second, range, options, quiet)?;
                (quantity::limit_curve::answer(&curve), curve.end)
            }
        };
        if matches!(end, BranchEnd::NotConverged { .. }) {
            early = Some(end.to_string());
        }
        Ok(answer)
    })?;
    if let Some(why) = early {
        let category = py.get_type::<PyRuntimeWarning>();
        let why = std::ffi::CString::new(why)?;
        PyErr::warn(py, &category, &why, 1)?;
    }
    Ok(answer)
}

/// A range with two ends.
fn distinct(range: [f64; 2]) -> Result<[f64; 2], Failure> {
    match range[0] == range[1] {
        false => Ok(range),
        true => Err(Failure::input("start and stop are the same value")),
    }
}

/// A number of the drive file, both ends of its range, and how many values it takes.
type Axis = (String, String, String, usize);

/// The drive over two numbers.
#[pyfunction]
pub(crate) fn map(
    py: Python<'_>,
    stated: Stated,
    x: Option<Axis>,
    y: Option<Axis>,
) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        file.drive()?;
        let axis =
            |option, given: Option<Axis>, usual: fn(&DriveFile) -> Option<MapAxis>| match given {
                Some(given) => axis(file, option, &given),
                None => usual(file).ok_or_else(|| {
                    Failure::Input(format!(
                        "the drive file gives no number for {option}; name one"
                    ))
                }),
            };
        let x = axis("x", x, MapAxis::speed)?;
        let y = axis("y", y, MapAxis::load)?;
        if x.varied == y.varied {
            return Err(Failure::input("x and y are the same number"));
        }
        let map = beltdrive::map(file, x, y, options, &mut |_, _| {})?;
        match map.points.iter().find_map(|point| point.as_ref().err()) {
            Some(refusal) if map.points.iter().all(Result::is_err) => Err(refusal.clone().into()),
            _ => Ok(quantity::map::answer(&map)),
        }
    })
}

/// The axis of a map.
fn axis(
    file: &DriveFile,
    option: &str,
    (path, from, to, count): &Axis,
) -> Result<MapAxis, Failure> {
    let fault = |problem: &str| Failure::Input(format!("{option} over `{path}`: {problem}"));
    if !(2..=1000).contains(count) {
        return Err(fault("the number of values is not from 2 to 1000"));
    }
    let (varied, range) = match path.as_str() {
        "load_factor" => {
            let factor = |text: &str| {
                let factor = text.parse::<f64>().ok().filter(|factor| *factor >= 0.0);
                factor.ok_or_else(|| fault("a load factor is a number that is not negative"))
            };
            (Varied::LoadFactor, [factor(from)?, factor(to)?])
        }
        value => {
            let key = file.key(Argument { option, value })?;
            let number = |value| Argument { option, value }.number(&key);
            let range = [number(from)?, number(to)?];
            (Varied::Key(key), range)
        }
    };
    match range[0] == range[1] {
        true => Err(fault("both ends are the same value")),
        false => Ok(MapAxis::over(varied, range, *count)),
    }
}

/// The best drive within its limits.
#[pyfunction]
pub(crate) fn design(py: Python<'_>, stated: Stated) -> PyResult<Answer> {
    let (answer, drive_file) = stated.ask(py, |file, options| {
        let question = file.design()?;
        let found = beltdrive::design(file, &question, options, &mut |_, _| {})?;
        let answer = quantity::design::answer(&found)?;
        let answer = match found.file.filled_in() {
            Some(filled_in) => quantity::section::told_in(answer, filled_in),
            None => answer,
        };
        let text = found.is_feasible.then(|| found.file.rewritten());
        Ok((answer, text.transpose()?))
    })?;
    Ok(Answer::new(answer).with_drive_file(drive_file))
}

/// Numbers of the drive file from measured rows.
#[pyfunction]
pub(crate) fn calibrate(
    py: Python<'_>,
    stated: Stated,
    name: &str,
    data: &str,
    free: Vec<String>,
) -> PyResult<Answer> {
    stated.answer(py, |file, options| {
        let drive = file.drive()?;
        let keys = file.free_keys(&free)?;
        let data = Measurements::read(name, data, file)?;
        let found = calibration(&keys, &data, options, &mut |_, _| {})?;
        Ok(quantity::calibration::answer(&drive, &found))
    })
}

/// Whether small axial motions grow.
#[pyfunction]
pub(crate) fn stability(py: Python<'_>, stated: Stated, modes: usize) -> PyResult<Answer> {
    stated.answer(py, |file, _| {
        if !(1..=60).contains(&modes) {
            return Err(Failure::input("modes must be from 1 to 60"));
        }
        let stability = beltdrive::stability(&file.drive()?, modes, &mut |_, _| {})?;
        Ok(quantity::stability::answer(&stability))
    })
}

/// Belt sections with their numbers.
#[pyfunction]
pub(crate) fn sections(name: Option<&str>) -> PyResult<Answer> {
    let answer = match name {
        Some(name) => {
            let found = beltdrive::sections::find(name);
            let found = found.map_err(|error| InputError::new_err(error.to_string()))?;
            quantity::section::one(found)
        }
        None => quantity::section::list(&beltdrive::sections::SECTIONS),
    };
    Ok(Answer::new(answer))
}

/// Published numbers, computed again.
#[pyfunction]
pub(crate) fn verify(py: Python<'_>) -> Answer {
    let verification = py.detach(|| beltdrive::verify(&mut |_, _| {}));
    Answer::new(quantity::verification::answer(&verification))
}

/// The names of the drive files that come with the package.
#[pyfunction]
pub(crate) fn examples() -> Vec<&'static str> {
    let examples = beltdrive::examples::EXAMPLES.iter();
    examples.map(|example| example.name).collect()
}

/// The text of an example, or of the measured rows `flat-bench.csv`.
#[pyfunction]
pub(crate) fn example(name: &str) -> PyResult<&'static str> {
    if name == "flat-bench.csv" {
        return Ok(beltdrive::examples::FLAT_BENCH);
    }
    let found = beltdrive::examples::find(name);
    let found = found.map_err(|error| InputError::new_err(error.to_string()))?;
    Ok(found.text)
}
