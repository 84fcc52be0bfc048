//! Where the search for a setup tension begins.

use super::search::Search;
use super::setting::Setting;
use crate::{BeltKind, Drive, Duty, Pulley, Side};

impl Search<'_> {
    /// About the value that has the asked margin: the preload that the drive has, or the mean tension of a rigid belt
    /// that is about to slip by Euler's formula.
    pub(super) fn start(&self, drive: &Drive) -> f64 {
        match (self.setting, drive.tensioner()) {
            (Setting::Preload { coordinate, .. }, Some((_, tensioner))) => {
                tensioner.load_at(coordinate)[0].abs()
            }
            _ => euler(drive, self.margin),
        }
    }
}

/// The mean tension of a rigid belt without inertia whose load, times a factor, makes the first pulley slip, and the
/// momentum flow, N; 0 if the belt cannot be laid round the pulleys.
fn euler(drive: &Drive, factor: f64) -> f64 {
    let Ok(layout) = drive.layout(drive.start_coordinate()) else {
        return 0.0;
    };
    let rim = drive.rim_speed();
    let pull = |pulley: &Pulley| match pulley.duty {
        Duty::Driver(_) | Duty::Driven => 0.0,
        Duty::Torque(torque) => factor * torque / pulley.radius,
        Duty::Power(power) => factor * power / rim,
    };
    let mut changes: Vec<_> = drive.pulleys.iter().map(pull).collect();
    changes[drive.driver()] = -changes.iter().sum::<f64>();
    // The tension of each span above that of the last one.
    let above: Vec<_> = { changes.iter() }
        .scan(0.0, |sum, change| {
            *sum += change;
            Some(*sum)
        })
        .collect();
    let count = changes.len();
    let slackest = (0..count).map(|index| {
        let pulley = &drive.pulleys[index];
        let half_angle = match drive.belt.kind {
            BeltKind::V(belt) if pulley.side == Side::Inside => {
                Some(pulley.half_angle.unwrap_or(belt.half_angle))
            }
            _ => None,
        };
        let wedge = half_angle.map_or(1.0, f64::sin);
        let grip = (pulley.friction_coefficient / wedge * layout.wraps()[index]).exp_m1();
        let change = changes[index].abs();
        let slack = above[index].min(above[(index + count - 1) % count]);
        change / grip - slack
    });
    let slackest = slackest.fold(f64::NEG_INFINITY, f64::max);
    let mean = above.iter().sum::<f64>() / count as f64;
    slackest + mean + drive.belt.mass_per_length * rim * rim
}
