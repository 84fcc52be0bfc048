//! The profiles of a steady state as comma-separated values.

use super::columns::COLUMNS;
use crate::{BeltKind, SteadyState};
use std::error::Error;

/// The profiles of both pulleys, one row per point of the belt, first along the driver.
///
/// The first column, `pulley`, is `driver` or `driven`; the others have the names and units of
/// the profiles in the JSON report, at full precision; the last one, of a flat belt, is the convention
/// for its normal force.
///
/// # Panics
/// Never: writing numbers into memory cannot fail.
pub fn csv(state: &SteadyState) -> String {
    write(state).expect("rows of one length, written into memory")
}

fn write(state: &SteadyState) -> Result<String, Box<dyn Error>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let convention = match state.drive.belt.kind {
        BeltKind::V(_) => None,
        BeltKind::Flat { normal_force } => Some(normal_force.name()),
    };
    let names = COLUMNS.iter().map(|column| column.key);
    let header = ["pulley"].into_iter().chain(names);
    writer.write_record(header.chain(convention.map(|_| "normal_force")))?;
    for (name, pulley) in [("driver", &state.driver), ("driven", &state.driven)] {
        let columns = COLUMNS.map(|column| column.values(&pulley.profile));
        for point in 0..pulley.profile.angle.len() {
            let values = columns.iter().map(|column| column[point].to_string());
            let values = [name.to_owned()].into_iter().chain(values);
            writer.write_record(values.chain(convention.map(str::to_owned)))?;
        }
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn has_a_header_and_one_row_per_point() {
        let state = sample::loaded();
        let text = csv(&state);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header: Vec<String> = reader
            .headers()
            .unwrap()
            .iter()
            .map(str::to_owned)
            .collect();
        let keys = COLUMNS.map(|column| column.key);
        assert_eq!(header[0], "pulley");
        assert_eq!(header[1..], keys);
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let [driver, driven] = [&state.driver, &state.driven].map(|p| p.profile.angle.len());
        assert_eq!(rows.len(), driver + driven);
        assert_eq!(
            rows.iter().filter(|row| &row[0] == "driven").count(),
            driven
        );
    }

    #[test]
    fn numbers_keep_their_precision() {
        let state = sample::loaded();
        let text = csv(&state);
        let row = text.lines().nth(6).unwrap();
        let values: Vec<&str> = row.split(',').collect();
        assert_eq!(
            values[3].parse::<f64>().unwrap(),
            state.driver.profile.tension[5]
        );
        let degrees = state.driver.profile.angle[5].to_degrees();
        assert_eq!(values[1].parse::<f64>().unwrap(), degrees);
    }

    #[test]
    fn no_profile_leaves_the_header() {
        assert_eq!(csv(&sample::blank()).lines().count(), 1);
    }
}
