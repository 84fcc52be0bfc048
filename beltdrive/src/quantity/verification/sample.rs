//! A verification with every verdict, for the tests of its reports.

use crate::verify::{Comparison, Criterion, Published, Section, Source, Verification};

/// Two sources; two numbers of the second are unexplained.
pub(crate) fn mixed() -> Verification {
    let row = |quantity, unit, text, criterion, computed| {
        Comparison::new(quantity, unit, Published::new(text), criterion, computed)
    };
    let digits = Criterion::Digits;
    let plot = Criterion::known("read off a plot", 373.205, 1e-3);
    let failed = Err("no steady state".to_owned());
    let mut remarked = row("wrap angle", "°", "180", digits, Ok(180.0));
    remarked.remark = Some("of the driver");
    Verification {
        sources: vec![
            Source {
                title: "Author (2001)",
                citation: "A. Author, A title, a publisher (2001)",
                method: "closed form",
                sections: vec![Section {
                    title: "Table 1, a",
                    comparisons: vec![
                        row("transition", "rad", "2.34", digits, Ok(2.3435)),
                        row(
                            "driven speed",
                            "rad/s",
                            "11.34",
                            Criterion::share(0.003, 11.34),
                            Ok(11.308),
                        ),
                        row("load", "N", "380", plot, Ok(373.205)),
                        remarked,
                    ],
                }],
            },
            Source {
                title: "Other (2002)",
                citation: "O. Other, Another title, a journal (2002)",
                method: "boundary value problem",
                sections: vec![Section {
                    title: "Text",
                    comparisons: vec![
                        row("load", "N", "380", plot, Ok(373.3)),
                        row("mass flow", "kg/s", "2.8", digits, failed),
                    ],
                }],
            },
        ],
    }
}
