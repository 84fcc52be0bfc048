//! Errors of numbers as their differences from those of a sharper state.

use super::{Group, Quantity, Value};

/// What the difference from a sharper state is multiplied by: that state keeps up to a quarter of the error.
const WHOLE: f64 = 4.0 / 3.0;

/// Gives each number its difference from that of a sharper state as its error, with the relative error of that. Both
/// hold the same quantities in the same order.
pub(super) fn by_difference<'g>(
    groups: impl IntoIterator<Item = &'g mut Group>,
    sharper: impl IntoIterator<Item = &'g Group>,
) {
    let of = groups.into_iter().flat_map(|group| &mut group.subjects);
    let sharper = sharper.into_iter().flat_map(|group| &group.subjects);
    for (subject, sharper) in of.zip(sharper) {
        for (quantity, sharper) in subject.quantities.iter_mut().zip(&sharper.quantities) {
            let errors = errors_of(quantity, sharper);
            quantity.error = errors.into_iter().fold(sharper.error, f64::max);
        }
    }
}

/// The errors of numbers under the keys of these, for programs.
pub(super) fn errors(quantities: &[Quantity], sharper: &[Quantity]) -> Vec<Quantity> {
    let pairs = quantities.iter().zip(sharper);
    let errors = pairs.filter_map(|(quantity, sharper)| {
        let errors = errors_of(quantity, sharper);
        let value = match (&quantity.value, &errors[..]) {
            (Value::Number(_), &[error]) => Value::Number(Some(error)),
            (Value::Parts(parts), errors) => {
                let names = parts.iter().map(|&(name, _)| name);
                Value::Parts(names.zip(errors.iter().copied()).collect())
            }
            _ => return None,
        };
        Some(Quantity {
            key: quantity.key.clone(),
            ..Quantity::data("", quantity.measure, value)
        })
    });
    errors.collect()
}

/// The errors of the numbers of a quantity, in their order; none if it holds no number.
fn errors_of(quantity: &Quantity, sharper: &Quantity) -> Vec<f64> {
    let pairs = numbers(&quantity.value)
        .into_iter()
        .zip(numbers(&sharper.value));
    pairs
        .map(|(of, sharper_one)| WHOLE * (of - sharper_one).abs() + sharper.error)
        .collect()
}

/// The numbers that a value holds.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(number) => number.iter().copied().collect(),
        Value::Pair(pair) => pair.to_vec(),
        Value::Parts(parts) => parts.iter().map(|&(_, part)| part).collect(),
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::super::Measure;
    use super::*;

    /// A number and two parts that are off by so much.
    fn off_by(error: f64) -> Vec<Quantity> {
        let parts = Value::Parts(vec![
            ("slack", 100.0 + error),
            ("tight", 700.0 - 2.0 * error),
        ]);
        vec![
            Quantity::number("torque", "torque", Measure::Torque, 150.0 + error, 1e-6),
            Quantity::data("tension", Measure::Force, parts),
            Quantity::word("name", "", "driver".to_owned()),
        ]
    }

    #[test]
    fn an_error_is_the_whole_difference_and_that_of_the_sharper_state() {
        let (of, sharper) = (off_by(0.75), off_by(0.0));
        let mut groups = [Group::single("", of.clone())];
        by_difference(&mut groups, &[Group::single("", sharper.clone())]);
        let known = groups[0].subjects[0].quantities.iter();
        let known: Vec<_> = known.map(|quantity| quantity.error).collect();
        assert_eq!(known, [1.000_001, 2.0, 0.0]);
        let errors = errors(&of, &sharper);
        assert_eq!(errors[0].value, Value::Number(Some(1.000_001)));
        let parts = Value::Parts(vec![("slack", 1.0), ("tight", 2.0)]);
        assert_eq!(errors[1].value, parts);
        assert_eq!(errors.len(), 2);
    }
}
