//! A branch as comma-separated values.

use crate::Branch;
use crate::report::{rows, state_columns::columns_beside, words};

/// The states of a branch and of its events, one row each, in order along the branch.
///
/// The first column is the parameter under its name in the JSON report. `event` and `pulley` say
/// what happens at a state; the other columns are the scalars of the JSON report with the pulley
/// in front of the name, at full precision.
pub fn csv(branch: &Branch) -> String {
    let columns = columns_beside(&branch.drive, &[branch.key]);
    let own = ["arclength", "event", "pulley"].map(str::to_owned);
    let header = std::iter::once(branch.key.column())
        .chain(own)
        .chain(columns.iter().map(|column| column.key.to_owned()));
    let rows = branch.rows().into_iter().map(|(point, event)| {
        let kind = event.map(|event| event.kind);
        let pulley = kind.and_then(words::event_pulley);
        let own = [
            branch.key.reported(point.value).to_string(),
            point.arclength.to_string(),
            kind.map_or("", words::event_kind).to_owned(),
            pulley.map_or("", words::pulley_word).to_owned(),
        ];
        let scalars = columns.iter().map(|column| column.text(&point.state));
        own.into_iter().chain(scalars).collect()
    });
    rows::csv(header.collect(), rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample_branch, sample_flat};

    #[test]
    fn has_one_row_per_state_with_its_event() {
        let branch = sample_branch::folded();
        let text = csv(&branch);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let place = |name| header.iter().position(|key| key == name).unwrap();
        assert_eq!(place("tight_tractive_tension_N"), 0);
        // The parameter is no second column, although it is a scalar of the state.
        assert_eq!(header.len(), 4 + 26);
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), branch.rows().len());
        let fold = rows.iter().find(|row| &row[place("event")] == "fold");
        let event = &branch.events[2];
        let driven = &event.point.state.driven;
        let fold = fold.unwrap();
        assert_eq!(fold[0].parse(), Ok(event.point.value));
        let speed = place("driven_angular_speed_rad_per_s");
        assert_eq!(fold[speed].parse(), Ok(driven.angular_speed));
        let overhang = rows.iter().find(|row| &row[2] == "overhang");
        assert_eq!(&overhang.unwrap()[3], "driver");
    }

    #[test]
    fn a_flat_belt_has_the_columns_of_a_v_belt_first() {
        let mut branch = sample_flat::branch();
        for point in &mut branch.points {
            point.state.driven.entry = None;
        }
        let (v, flat) = (csv(&sample_branch::folded()), csv(&branch));
        let own = flat.lines().next().unwrap();
        let own = own.strip_prefix(v.lines().next().unwrap()).unwrap();
        assert_eq!(own.split(',').count(), 1 + 7);
        assert!(own.starts_with(",driver_reference_tension_N,driver_entry_strain,"));
        assert!(
            flat.lines()
                .nth(3)
                .unwrap()
                .ends_with(",765432.1,,,,inertia")
        );
    }
}
