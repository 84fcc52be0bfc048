//! Random problems of families on which solvers go wrong: is every success true?

mod beside_scipy;
mod draw;
mod growth;
mod hostile;
mod insoluble;
mod integrate;
mod isolated;
mod jumps;
mod layers;
mod results;
mod scales;
mod seeds;
mod shocks;
mod singular_ends;
mod smooth;
mod survey;
mod trial;

use survey::{Family, Survey};

const FAMILIES: [Family; 10] = [
    Family {
        seed: 0,
        name: "smooth",
        draw: smooth::draw,
    },
    Family {
        seed: 1,
        name: "jumps",
        draw: jumps::draw,
    },
    Family {
        seed: 2,
        name: "layers",
        draw: layers::draw,
    },
    Family {
        seed: 3,
        name: "scales",
        draw: scales::draw,
    },
    Family {
        seed: 4,
        name: "not isolated",
        draw: isolated::draw,
    },
    Family {
        seed: 5,
        name: "insoluble",
        draw: insoluble::draw,
    },
    Family {
        seed: 6,
        name: "growth",
        draw: growth::draw,
    },
    Family {
        seed: 7,
        name: "singular ends",
        draw: singular_ends::draw,
    },
    Family {
        seed: 8,
        name: "shocks",
        draw: shocks::draw,
    },
    Family {
        seed: 9,
        name: "seeds",
        draw: seeds::draw,
    },
];

/// Tries the first problems of a family: none of the successes is false, nothing panics, and at least
/// a share of them is solved.
fn check(name: &str, count: u32, share: f64) {
    let family = FAMILIES
        .iter()
        .find(|family| family.name == name)
        .expect("a family");
    let survey = Survey::of(family, count);
    println!("{}", survey.lines(name));
    assert!(survey.wrong.is_empty(), "{}", survey.wrong.join("\n"));
    let total = survey.total(None);
    let solved = (total.solved + total.another) as f64;
    assert!(
        solved >= share * f64::from(count),
        "{solved} of {count} solved"
    );
}

#[test]
fn smooth_problems() {
    check("smooth", 300, 0.98);
}

#[test]
fn problems_with_layers() {
    check("layers", 600, 0.95);
}

#[test]
fn growth_from_seeds() {
    check("seeds", 400, 0.9);
}

#[test]
fn problems_without_a_solution() {
    check("insoluble", 300, 0.0);
}
