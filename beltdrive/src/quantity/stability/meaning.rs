//! What the stability of a drive means, in one sentence.

use super::words::{is_neutral, pulleys};
use crate::input::Key;
use crate::quantity::value;
use crate::{Drive, FormStability, Onset, PulleyStability, Role, Stability};

/// The sentence.
pub(super) fn meaning(stability: &Stability) -> String {
    let thesis = thesis(stability);
    if !conserves(stability) {
        return format!(
            "{thesis}; the conservative form, which has no growth, shows some here, so that none of \
             these rates can be trusted."
        );
    }
    let cause = cause(stability);
    if slips_nowhere(stability) {
        format!(
            "{thesis}; the belt slips nowhere at this load, and with the natural outlet condition \
             its motion is exactly conservative (Re λ = 0), so that {cause} not from the drive."
        )
    } else {
        format!(
            "{thesis}; with the inertia of the normal force and the natural outlet condition kept \
             the motion is exactly conservative (Re λ = 0), so that {cause} not from the drive."
        )
    }
}

/// The form of the thesis.
fn thesis_form(pulley: &PulleyStability) -> &FormStability {
    &pulley.forms[0]
}

fn conserves(stability: &Stability) -> bool {
    let mut conservative = pulleys(stability).into_iter().map(|(_, on)| &on.forms[2]);
    conservative.all(|form| form.modes.iter().all(is_neutral))
}

fn slips_nowhere(stability: &Stability) -> bool {
    let mut pulleys = pulleys(stability).into_iter();
    pulleys.all(|(_, on)| on.transition >= on.contact_length)
}

/// What happens with the outlet condition of the thesis.
fn thesis(stability: &Stability) -> String {
    let drive = &stability.drive;
    let of_pulleys = pulleys(stability).map(|(pulley, on)| (pulley, thesis_form(on)));
    let now: Vec<_> = of_pulleys
        .iter()
        .filter(|(_, form)| form.is_unstable())
        .map(|(pulley, form)| format!("on the {}{}", pulley.name(), since(drive, form)))
        .collect();
    let start = "With the thesis's outlet condition";
    if !now.is_empty() {
        return format!("{start} the belt is unstable {}", now.join(" and "));
    }
    let elsewhere: Vec<_> = of_pulleys
        .iter()
        .filter_map(|(pulley, form)| other_load(drive, *pulley, form))
        .collect();
    if elsewhere.is_empty() {
        format!("{start} every motion found decays, at this load and at all that were tried")
    } else {
        format!(
            "{start} every motion found decays at this load, but the belt {}",
            elsewhere.join(" and ")
        )
    }
}

/// From which load on a form that is unstable is so, if that is known.
fn since(drive: &Drive, form: &FormStability) -> String {
    match form.onset {
        Some(Onset::At { load, mode }) if load <= Key::load(drive).get(drive) => {
            format!(", as it is from {} on{}", place(drive, load), first(mode))
        }
        _ => String::new(),
    }
}

/// At which other load a form that is stable at this one turns unstable.
fn other_load(drive: &Drive, pulley: Role, form: &FormStability) -> Option<String> {
    let Some(Onset::At { load, mode }) = form.onset else {
        return None;
    };
    let verb = if load > Key::load(drive).get(drive) {
        "turns unstable"
    } else {
        "is unstable for a while"
    };
    let (name, place, first) = (pulley.name(), place(drive, load), first(mode));
    Some(format!("on the {name} {verb} at {place}{first}"))
}

fn place(drive: &Drive, load: f64) -> String {
    let key = Key::load(drive);
    let load = value::quantity(key, load, None);
    format!("a {} of {load}", key.name())
}

fn first(mode: Option<usize>) -> String {
    match mode {
        Some(mode) => format!(" (mode {mode} first)"),
        None => " (high modes as soon as any)".to_owned(),
    }
}

/// What growth and decay come from.
fn cause(stability: &Stability) -> String {
    let grows = |on: &PulleyStability| {
        let form = thesis_form(on);
        form.is_unstable() || matches!(form.onset, Some(Onset::At { .. }))
    };
    let [growing, decaying]: [Vec<_>; 2] = [true, false].map(|wanted| {
        let pulleys = pulleys(stability).into_iter();
        let found = pulleys.filter(|(_, on)| grows(on) == wanted);
        found.map(|(pulley, _)| pulley.name()).collect()
    });
    match (growing.as_slice(), decaying.as_slice()) {
        ([], _) => "this decay comes from the terms left out and".to_owned(),
        (_, [other]) => {
            format!("this growth, like the decay on the {other}, comes from the terms left out and")
        }
        _ => "this growth comes from the terms left out and".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::LinearisedForm;

    fn with(load: f64, change: impl Fn(&mut Stability)) -> String {
        let mut stability = sample::stability();
        Key::load(&stability.drive.clone()).set(&mut stability.drive, load);
        change(&mut stability);
        meaning(&stability)
    }

    const STANDARD: &str = "; with the inertia of the normal force and the natural outlet condition \
        kept the motion is exactly conservative (Re λ = 0), so that this growth, like the decay on \
        the driven pulley, comes from the terms left out and not from the drive.";

    #[test]
    fn stable_here_but_not_beyond() {
        let first = "With the thesis's outlet condition every motion found decays at this load, but \
            the belt on the driver turns unstable at a tight tractive tension of 480 N (mode 2 first)";
        assert_eq!(with(420.0, |_| ()), format!("{first}{STANDARD}"));
        let beyond = with(500.0, |_| ());
        assert!(beyond.contains("but the belt on the driver is unstable for a while at a tight"));
    }

    #[test]
    fn unstable_already() {
        let unstable = |stability: &mut Stability| stability.driver.forms[0].modes[1].growth = 4.0;
        let first = "With the thesis's outlet condition the belt is unstable on the driver, as it is \
            from a tight tractive tension of 480 N on (mode 2 first)";
        assert_eq!(with(500.0, unstable), format!("{first}{STANDARD}"));
        // What grows first is another mode than those of the search.
        let text = with(470.0, unstable);
        assert!(text.contains("is unstable on the driver; with"), "{text}");
        let text = with(500.0, |stability| {
            let load = 490.0;
            unstable(stability);
            stability.driven.forms[0].high_mode_limit = 1.0;
            stability.driven.forms[0].onset = Some(Onset::At { load, mode: None });
        });
        assert!(text.contains("(mode 2 first) and on the driven pulley, as it is from"));
        assert!(
            text.contains("490 N on (high modes as soon as any); with"),
            "{text}"
        );
        assert!(text.contains("so that this growth comes from"), "{text}");
    }

    #[test]
    fn never_unstable() {
        let text = with(420.0, |stability| {
            stability.driver.forms[0].onset = Some(Onset::Never);
        });
        assert!(
            text.contains("decays, at this load and at all that were tried; with"),
            "{text}"
        );
        assert!(text.contains("so that this decay comes from"), "{text}");
    }

    #[test]
    fn slipping_nowhere() {
        let text = with(420.0, |stability| {
            for pulley in [&mut stability.driver, &mut stability.driven] {
                pulley.transition = pulley.contact_length;
            }
        });
        assert!(
            text.contains("; the belt slips nowhere at this load, and with"),
            "{text}"
        );
    }

    #[test]
    fn rates_that_cannot_be_are_not_explained() {
        let text = with(420.0, |stability| {
            let form = &mut stability.driven.forms[2];
            assert_eq!(form.form, LinearisedForm::Conservative);
            form.modes[0].growth = 1.0;
        });
        assert!(text.ends_with("none of these rates can be trusted."));
    }
}
