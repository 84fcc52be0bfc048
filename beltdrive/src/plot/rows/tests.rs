use super::super::tests::check;
use super::diagram::{COVERED, CURVE};
use super::*;
use crate::quantity::{branch, limit_curve};
use crate::results::samples;
use crate::{Branch, LimitCurve};

fn rows(answer: &Answer) -> &[Subject] {
    let mut groups = answer.groups.iter();
    let group = groups.find(|group| group.layout == Layout::Rows).unwrap();
    &group.subjects
}

fn drawn(branch: &Branch) -> String {
    let figure = figure(&branch::answer(branch));
    check(&figure);
    figure
}

#[test]
fn the_branch_is_parted_at_its_limit_point() {
    let mut folded = samples::branch::folded();
    let answer = branch::answer(&folded);
    let found = pieces(rows(&answer), &[]);
    let [before, behind] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(before.rows.end(), behind.rows.start());
    let fold = &rows(&answer)[*behind.rows.start()];
    assert_eq!(
        fold.number(&folded.key.stem()),
        Some(folded.events[2].point.value)
    );
    assert_eq!((before.behind, behind.behind), (false, true));
    let figure = drawn(&folded);
    assert!(figure.contains(">behind the limit point<") && figure.contains("dasharray"));
    for title in [
        "Speed of the driven pulley",
        "Efficiency",
        "Wrap angle",
        "Inclination at exit",
    ] {
        assert!(figure.contains(&format!(">{title}<")), "{title}");
    }
    folded.events.remove(2);
    assert_eq!(pieces(rows(&branch::answer(&folded)), &[]).len(), 1);
}

#[test]
fn a_parameter_over_decades_has_powers_of_ten_unless_it_turns_back() {
    let mut branch = samples::branch::folded();
    for point in &mut branch.points {
        point.value = 1e5 * 10_f64.powf(5.0 * point.arclength);
    }
    assert!(!drawn(&branch).contains(">1e5<"));
    branch.events.clear();
    assert!(drawn(&branch).contains(">1e5<"));
}

#[test]
fn events_are_numbered_and_told() {
    let mut branch = samples::branch::folded();
    branch.events[1].point = branch.events[0].point.clone();
    let figure = drawn(&branch);
    assert!(figure.contains(">1, 2<"));
    assert!(figure.contains("3   8221.01 N: limit point: the tight tractive tension turns back"));
}

#[test]
fn a_branch_of_one_state_has_a_figure() {
    let mut branch = samples::branch::folded();
    branch.points.truncate(1);
    branch.events.clear();
    drawn(&branch);
}

fn chart(curve: &LimitCurve) -> String {
    let figure = figure(&limit_curve::answer(curve));
    check(&figure);
    figure
}

#[test]
fn a_curve_of_limits_is_parted_where_the_reason_changes() {
    let mut curve = samples::branch::curve();
    let answer = limit_curve::answer(&curve);
    let reasons = reasons(rows(&answer));
    assert_eq!(reasons, ["fold: driver slips", "fold: driver overhangs"]);
    let pieces = pieces(rows(&answer), &reasons);
    let lengths: Vec<_> = pieces
        .iter()
        .map(|piece| piece.rows.clone().count())
        .collect();
    assert_eq!(lengths.iter().sum::<usize>(), curve.points.len());
    assert_eq!(lengths.len(), 2);
    let figure = chart(&curve);
    assert!(figure.contains(">0.2<") && figure.contains(">40000<") && !figure.contains("cusp"));
    curve.cusps = vec![curve.points[3].clone()];
    assert!(chart(&curve).contains("cusp: two limit points meet and vanish"));
    curve.cusps.clear();
    for (power, point) in (0..).zip(&mut curve.points) {
        point.second = 1e4 * 10_f64.powf(0.2 * f64::from(power));
    }
    let figure = chart(&curve);
    for tick in ["1e4", "1e5", "1e6", "1e7", "1e8"] {
        assert!(figure.contains(&format!(">{tick}<")), "{tick}");
    }
}

#[test]
fn flat_belts_have_charts_of_their_own() {
    let branch = drawn(&samples::flat::branch());
    assert!(branch.contains(">Slip arc<"));
    for figure in [branch, chart(&samples::flat::curve())] {
        assert!(figure.contains("normal force n = (T − G V)/R"));
        for word in ["nclination", "enetration", "groove", "V-belt"] {
            assert!(!figure.contains(word), "{word}");
        }
    }
}

#[test]
fn a_pulley_behind_another_curve_is_seen() {
    let curve = |values: [f64; 3]| Curve {
        rows: values.to_vec(),
        marked: vec![],
    };
    let same = Diagram {
        title: String::new(),
        axis: String::new(),
        scale: Scale::Decimal,
        curves: vec![
            curve([1.0, 2.0, 3.0]),
            curve([1.0, 2.0, 3.0]),
            curve([1.0, 5.0, 9.0]),
        ],
    };
    let widths: Vec<_> = same.strokes().iter().map(|stroke| stroke.width).collect();
    assert_eq!(widths, [COVERED, CURVE, CURVE]);
}
