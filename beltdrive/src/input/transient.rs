//! How a drive moves in time: the table `[transient]` of a drive file.

use super::{
    Argument, Diagnostic, DriveFile, check, diagnostic::Finding, dimension::Dimension,
    document::Content, file, overrides, schema, values::Values,
};
use crate::transient::{
    Axle, Cells, Load, Motion, Motor, Pluck, Pulsation, RunOut, Schedule, Simulation, Start,
    StepBound, TransientError, Transverse, Until,
};
use crate::{Drive, Duty};

/// The list of pulleys of `[transient]`.
const PULLEY: &str = "transient.pulley";

/// The table of the motion of the spans across.
const TRANSVERSE: &str = "transient.transverse";

/// Direction of gravity without `transient.transverse.gravity_direction`, rad: against y.
const DOWNWARDS: f64 = -std::f64::consts::FRAC_PI_2;

/// The end of a run, or the latest end of one to the steady state.
const END: &str = "transient.end";

/// The time between two samples.
const SAMPLED: &str = "transient.interval";

/// The longest time step.
const STEP: &str = "transient.time_step";

/// The cells of the mesh.
const CELLS_OF_MESH: &str = "transient.cells";

/// Axial damping of the belt.
const DAMPING: &str = "transient.axial_damping";
const FRICTION_DAMPING: &str = "transient.friction_damping";

/// Cells of the mesh without `transient.cells`: the load step of the documentation is then off by a few thousandths
/// in speed and tensions, at a second of computing per second.
const CELLS: usize = 240;

/// Time between two samples without `transient.interval`, s: the fastest torsional vibrations of drives have some
/// hundred hertz.
const INTERVAL: f64 = 1e-3;

/// The latest end of a run to the steady state without `transient.end`, s.
const LATEST: f64 = 10.0;

impl DriveFile {
    /// The drive in time, as the table `[transient]` states it, to an end on a command line: a time with its unit,
    /// `steady`, `slip` or `slack`; without one to `transient.end`.
    ///
    /// # Errors
    /// There is no such table, it lacks what a pulley needs, its values do not belong together, or the end is no time.
    pub fn simulation(&self, until: Option<Argument<'_>>) -> Result<Simulation, Diagnostic> {
        self.simulated(None, |values| {
            until.map(|until| self.until(until, values)).transpose()
        })
    }

    /// The drive in time as [`Self::simulation`] gives it, but as it runs, for what asks for no start and no end.
    ///
    /// # Errors
    /// As [`Self::simulation`], but for the end.
    pub fn motion(&self) -> Result<Simulation, Diagnostic> {
        let end = Until::Steady { latest: LATEST };
        self.simulated(Some(Start::Running), |_| Ok(Some(end)))
    }

    /// Why a simulation of this file fails, at the key that says what is at fault; `None` where no key does.
    #[must_use]
    pub fn of_simulation(
        &self,
        simulation: &Simulation,
        error: &TransientError,
    ) -> Option<Diagnostic> {
        let end = simulation.until.latest();
        let values = Values::check(&self.document, &self.source).ok()?;
        let name = |pulley: usize| &simulation.drive.pulleys[pulley].name;
        let of_pulley = |name: &str, keys: &[&str]| -> Vec<_> {
            keys.iter()
                .map(|key| format!("{PULLEY}.{name}.{key}"))
                .collect()
        };
        let keys = match error {
            TransientError::Unstable { .. } => vec![STEP.to_owned()],
            TransientError::TooManySteps { bound, .. } => match *bound {
                StepBound::Asked => vec![STEP.to_owned()],
                StepBound::Cells => vec![CELLS_OF_MESH.to_owned()],
                StepBound::Bristles { pulley } => of_pulley(name(pulley), &["inertia"]),
                StepBound::AxialDamping => vec![DAMPING.to_owned()],
                StepBound::DampingAcross => vec![format!("{TRANSVERSE}.damping")],
                StepBound::Torque { pulley } => {
                    of_pulley(name(pulley), &["load_per_speed", "motor_torque_over_speed"])
                }
                StepBound::Pulsation { pulley } => of_pulley(name(pulley), &["load_frequency"]),
                StepBound::RunOut { pulley } => {
                    of_pulley(name(pulley), &["run_out_order", "run_out"])
                }
            },
            TransientError::Statement {
                subject,
                key: Some(key),
                ..
            } => match values.number(END) == Some(end) {
                // Too many samples may also be the fault of the end.
                true if *key == SAMPLED => vec![SAMPLED.to_owned(), END.to_owned()],
                _ => vec![key.replace('*', subject)],
            },
            _ => vec![],
        };
        let key = keys.iter().find(|path| values.has(path))?;
        let finding = Finding::new(values.place(key), error.to_string());
        Some(Diagnostic::new(finding, &self.source))
    }

    fn simulated(
        &self,
        start: Option<Start>,
        until: impl FnOnce(&Values<'_>) -> Result<Option<Until>, Diagnostic>,
    ) -> Result<Simulation, Diagnostic> {
        let values = Values::check(&self.document, &self.source);
        let stated = values.and_then(|values| Ok((file::drive(&values)?, values)));
        let (drive, values) = stated.map_err(|finding| Diagnostic::new(finding, &self.source))?;
        let asked = until(&values)?;
        self.stated(drive, &values, (start, asked))
            .map_err(|finding| Diagnostic::new(finding, &self.source))
    }

    /// The end that a command line asks for.
    fn until(&self, until: Argument<'_>, values: &Values<'_>) -> Result<Until, Diagnostic> {
        let latest = values.number(END).unwrap_or(LATEST);
        match until.value {
            "steady" => return Ok(Until::Steady { latest }),
            "slip" => return Ok(Until::Slip { latest }),
            "slack" => return Ok(Until::Slack { latest }),
            _ => {}
        }
        let time = check::quantity(END, &until.entry(), &until.source());
        time.map(Until::Time).map_err(|finding| {
            until.diagnose(finding.help(
                "or `steady`, for the time when nothing changes any more, `slip` or `slack`, for the first of its kind",
            ))
        })
    }

    fn stated(
        &self,
        drive: Drive,
        values: &Values<'_>,
        (start, asked): (Option<Start>, Option<Until>),
    ) -> Result<Simulation, Finding> {
        if !values.has("transient") {
            let end = self.document.end.clone();
            let message = "nothing says how the drive moves in time";
            return Err(Finding::new(end, message)
                .expected("[transient], with [transient.pulley.NAME] for each pulley"));
        }
        let names: Vec<_> = { drive.pulleys.iter() }
            .map(|pulley| pulley.name.clone())
            .collect();
        self.known_pulleys(&names)?;
        let start = start.unwrap_or(match values.text("transient.start") {
            Some("running") => Start::Running,
            _ => Start::Rest,
        });
        let until = match (asked, values.number(END)) {
            (Some(asked), _) => asked,
            (None, Some(end)) => Until::Time(end),
            (None, None) => return Err(values.missing(&[END])),
        };
        let axles = drive.pulleys.iter();
        let axles = axles.map(|pulley| axle(values, &pulley.name, pulley.duty, start));
        let cells = whole(values, CELLS_OF_MESH);
        Ok(Simulation {
            axles: axles.collect::<Result<_, _>>()?,
            drive,
            axial_damping: values.number(DAMPING).unwrap_or(0.0),
            friction_damping: values.number(FRICTION_DAMPING).unwrap_or(0.0),
            transverse: transverse(values, &names)?,
            start,
            cells: Cells::Total(cells.unwrap_or(CELLS)),
            until,
            interval: values.number(SAMPLED).unwrap_or(INTERVAL),
            instants: vec![],
            frames: 0,
            step: values.number(STEP),
        })
    }

    /// Refuses a table of a pulley that there is not.
    fn known_pulleys(&self, names: &[String]) -> Result<(), Finding> {
        let tables = self.document.entries.iter();
        for (path, entry) in tables.filter(|(_, entry)| entry.content == Content::Table) {
            let name = path
                .strip_prefix(PULLEY)
                .and_then(|rest| rest.strip_prefix('.'));
            if let Some(name) = name
                && !names.iter().any(|known| known == name)
            {
                let place = entry.key.clone();
                return Err(overrides::unknown(
                    schema::PULLEY,
                    "pulley",
                    names,
                    (name, place),
                ));
            }
        }
        Ok(())
    }
}

/// A whole number of the file.
fn whole(values: &Values<'_>, path: &str) -> Option<usize> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 1 to 1000"
    )]
    let whole = values.number(path).map(|number| number as usize);
    whole
}

/// Motion of the spans across: there is one with a table of it.
fn transverse(values: &Values<'_>, names: &[String]) -> Result<Option<Transverse>, Finding> {
    let of_pulleys = |key: &str| {
        let path = move |name: &String| format!("{PULLEY}.{name}.{key}");
        names.iter().map(path).collect::<Vec<_>>()
    };
    let [run_outs, orders, plucks, modes] =
        ["run_out", "run_out_order", "pluck", "pluck_mode"].map(of_pulleys);
    if !values.has(TRANSVERSE) {
        let mut keys = [&run_outs, &orders, &plucks, &modes].into_iter().flatten();
        return match keys.find(|path| values.has(path)) {
            Some(path) => {
                let message = "nothing says that the spans move across";
                Err(Finding::new(values.key_place(path), message)
                    .expected("[transient.transverse], which may be empty"))
            }
            None => Ok(None),
        };
    }
    for (whole, of) in [(&orders, &run_outs), (&modes, &plucks)] {
        let mut pairs = whole.iter().zip(of);
        if let Some((path, needed)) = pairs.find(|(path, of)| values.has(path) && !values.has(of)) {
            let message = format!("`{}` needs an amplitude", schema::split(path).1);
            let expected = format!("`{}`", schema::split(needed).1);
            return Err(Finding::new(values.key_place(path), message).expected(expected));
        }
    }
    let of = |key: &str| values.number(&format!("{TRANSVERSE}.{key}"));
    let gravity = of("gravity").unwrap_or(0.0);
    let direction = of("gravity_direction").unwrap_or(DOWNWARDS);
    let plucks = plucks.iter().zip(&modes).map(|(path, mode)| {
        values.number(path).map(|amplitude| Pluck {
            amplitude,
            mode: whole(values, mode).unwrap_or(1),
        })
    });
    let run_outs = run_outs.iter().zip(&orders).map(|(path, order)| {
        values.number(path).map(|amplitude| RunOut {
            amplitude,
            order: whole(values, order).unwrap_or(1),
        })
    });
    Ok(Some(Transverse {
        damping: of("damping").unwrap_or(0.0),
        gravity: [gravity * direction.cos(), gravity * direction.sin()],
        plucks: plucks.collect(),
        run_outs: run_outs.collect(),
    }))
}

/// The axle of a pulley.
fn axle(values: &Values<'_>, name: &str, duty: Duty, start: Start) -> Result<Axle, Finding> {
    let path = |key: &str| format!("{PULLEY}.{name}.{key}");
    let inertia = path("inertia");
    let motors = ["motor_torque", "motor_torque_over_speed"].map(path);
    let given: Vec<_> = motors.iter().filter(|path| values.has(path)).collect();
    if let [_, second] = given[..] {
        let message = format!("the motor of `{name}` has a torque over time and one over speed");
        return Err(Finding::new(values.key_place(second), message).expected("one of them"));
    }
    let speed = path("speed");
    let stated = match (values.points(&speed), duty) {
        (Some(points), _) => Some(schedule(values, &speed, points, true)?),
        (None, Duty::Driver(speed)) if given.is_empty() && start == Start::Running => {
            Some(Schedule::constant(speed))
        }
        (None, Duty::Driver(_)) if given.is_empty() => {
            return Err(values.missing(&[&speed, &motors[0], &motors[1]]));
        }
        (None, _) => None,
    };
    let loads = [
        "load",
        "load_per_speed",
        "load_sense",
        "load_amplitude",
        "load_frequency",
    ];
    let loads = loads.map(path);
    if let Some(speed) = stated {
        let others = motors.iter().chain(&loads);
        if let Some(other) = { others }.find(|path| values.has(path)) {
            let message = format!("the speed of `{name}` is given, so that no torque decides it");
            return Err(Finding::new(values.key_place(other), message)
                .expected("either `speed`, or torques"));
        }
        return Ok(Axle {
            inertia: values.number(&inertia).unwrap_or(0.0),
            motion: Motion::Speed(speed),
        });
    }
    let motor = match (values.points(&motors[0]), values.points(&motors[1])) {
        (Some(points), _) => Some(Motor::Torque(schedule(values, &motors[0], points, false)?)),
        (None, Some(points)) => {
            let torque = schedule(values, &motors[1], points, true)?;
            Some(Motor::Characteristic(torque))
        }
        (None, None) => None,
    };
    let torque = match (values.points(&loads[0]), duty) {
        (Some(points), _) => schedule(values, &loads[0], points, false)?,
        (None, Duty::Torque(torque)) => Schedule::constant(torque),
        (None, Duty::Driver(_)) => Schedule::constant(0.0),
        (None, Duty::Power(_) | Duty::Driven) => return Err(values.missing(&[&loads[0]])),
    };
    let [amplitude, frequency] = [&loads[3], &loads[4]];
    let torque = match (values.number(amplitude), values.number(frequency)) {
        (Some(amplitude), Some(angular_frequency)) => torque.pulsating(Pulsation {
            amplitude,
            angular_frequency,
        }),
        (None, None) => torque,
        (Some(_), None) => return Err(values.missing(&[frequency])),
        (None, Some(_)) => return Err(values.missing(&[amplitude])),
    };
    Ok(Axle {
        inertia: values.required_number(&inertia)?,
        motion: Motion::Torques {
            motor,
            load: Load {
                torque,
                per_speed: values.number(&loads[1]).unwrap_or(0.0),
                is_one_way: values.text(&loads[2]) == Some("one-way"),
            },
        },
    })
}

/// The schedule through points, which may be one that must not jump.
fn schedule(
    values: &Values<'_>,
    path: &str,
    points: &[[f64; 2]],
    is_continuous: bool,
) -> Result<Schedule, Finding> {
    let (_, key) = schema::split(path);
    let found = Schedule::table(points.to_vec());
    let schedule = found.ok_or_else(|| {
        let mut pairs = points.windows(2);
        let falls = pairs.position(|pair| pair[0][0] > pair[1][0]);
        let (place, message) = match falls {
            Some(before) => {
                let [earlier, later] = [points[before + 1][0], points[before][0]];
                let message =
                    format!("the points of `{key}` are out of order: {earlier} after {later}");
                (values.point_place(path, before + 1), message)
            }
            None => (values.place(path), format!("`{key}` has no points")),
        };
        Finding::new(place, message).expected("points in ascending order")
    })?;
    match schedule.first_jump() {
        Some(jump) if is_continuous => {
            let message = format!("`{key}` must not jump, as it does at {jump}");
            Err(Finding::new(values.place(path), message)
                .expected("two points at different places, with a steep line between them"))
        }
        _ => Ok(schedule),
    }
}

impl Argument<'_> {
    /// A time of a run with its unit, s; 0 is its start.
    ///
    /// # Errors
    /// The value is no time, or negative.
    pub fn time(&self) -> Result<f64, Diagnostic> {
        let end = schema::rule(END).expect("a key is one of the schema");
        let range = schema::Range::NotNegative;
        let (entry, source) = (self.entry(), self.source());
        check::number(self.option, end, Dimension::TIME, range, &entry, &source)
            .map_err(|finding| self.diagnose(finding))
    }
}
