//! Where the numbers of events stand beside their dots.

use super::occupied::Frame;
use super::style::{SMALL, text_width};

/// How far the middle of a digit is from its dot, across and down, px.
const BESIDE: f64 = 9.0;

/// How far it is above or below its dot, where it is not beside it, px.
const ABOVE: f64 = 14.0;

/// Half the height of a number, and of the part of a dot that stays free, px.
const HALF: f64 = 6.0;
const FREE: f64 = 3.0;

/// Dots that are no farther apart look like one, px.
const TOGETHER: f64 = 2.0;

/// The number of an event, or of several whose numbers would overlap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    /// The numbers.
    pub(super) text: String,
    /// Where its middle is, from the dot of the event that has it, px.
    pub(super) offset: [f64; 2],
}

/// The labels of the events of a panel, by curve and event, so that none covers another one.
///
/// `dots` has the places of all events on every curve, px. Of events with a common label the last
/// one has it. Where events have the same places on two curves, the curve that is drawn later has the
/// label. No label is moved out of `frame`.
pub(super) fn place(dots: &[Vec<[f64; 2]>], frame: Frame) -> Vec<Vec<Option<Label>>> {
    let groups: Vec<_> = dots.iter().map(|dots| groups(dots)).collect();
    let mut labels: Vec<Vec<_>> = dots.iter().map(|dots| vec![None; dots.len()]).collect();
    let mut placed: Vec<Frame> = Vec::new();
    for (curve, own) in groups.iter().enumerate() {
        for group in own {
            let mut later = groups[curve + 1..].iter().flatten();
            if later.any(|other| group.looks_like(other)) {
                continue;
            }
            let cost = |(number, middle): &(usize, [f64; 2])| {
                let label = group.frame(*middle);
                let others = placed.iter().filter(|other| label.meets(other)).count();
                // The usual place may reach out of the frame a little.
                let outside = *number > 0 && !frame.contains(&label);
                let dots = dots.iter().flatten();
                let covers = |dot: &&[f64; 2]| label.meets(&Frame::around(**dot, [FREE; 2]));
                (others, outside, dots.filter(covers).count())
            };
            let places = group.places().into_iter().enumerate();
            if let Some((_, middle)) = places.min_by_key(cost) {
                placed.push(group.frame(middle));
                let owner = group.last();
                let dot = dots[curve][owner];
                labels[curve][owner] = Some(Label {
                    text: group.text(),
                    offset: [0, 1].map(|axis| middle[axis] - dot[axis]),
                });
            }
        }
    }
    labels
}

/// Events of a curve with a common label.
#[derive(Clone, Debug)]
struct Group {
    /// Which ones, in order.
    events: Vec<usize>,
    /// The rectangle of their dots.
    dots: Frame,
}

/// The events of a curve in groups whose labels at the usual place do not overlap.
fn groups(dots: &[[f64; 2]]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (event, dot) in dots.iter().enumerate() {
        let mut group = Group {
            events: vec![event],
            dots: Frame::around(*dot, [0.0; 2]),
        };
        let usual = |group: &Group| group.frame(group.places()[0]);
        while let Some(other) = groups
            .iter()
            .position(|other| usual(other).meets(&usual(&group)))
        {
            group = group.with(groups.swap_remove(other));
        }
        groups.push(group);
    }
    groups.sort_by_key(Group::last);
    groups
}

impl Group {
    fn with(mut self, other: Self) -> Self {
        self.events.extend(other.events);
        self.events.sort_unstable();
        for axis in 0..2 {
            self.dots.from[axis] = self.dots.from[axis].min(other.dots.from[axis]);
            self.dots.to[axis] = self.dots.to[axis].max(other.dots.to[axis]);
        }
        self
    }

    fn last(&self) -> usize {
        self.events[self.events.len() - 1]
    }

    /// Whether the other group of the same events has its dots at the same places.
    fn looks_like(&self, other: &Self) -> bool {
        let near = |one: [f64; 2], other: [f64; 2]| {
            (0..2).all(|axis| (one[axis] - other[axis]).abs() <= TOGETHER)
        };
        self.events == other.events
            && near(self.dots.from, other.dots.from)
            && near(self.dots.to, other.dots.to)
    }

    /// The numbers of the events; three and more in a row are a range.
    fn text(&self) -> String {
        let runs = self.events.chunk_by(|one, next| one + 1 == *next);
        let texts = runs.flat_map(|run| match run {
            [first, .., last] if run.len() > 2 => vec![format!("{}–{}", first + 1, last + 1)],
            few => few.iter().map(|event| (event + 1).to_string()).collect(),
        });
        texts.collect::<Vec<_>>().join(", ")
    }

    /// By how much the label is wider than one digit, px.
    fn excess(&self) -> f64 {
        text_width(self.text().chars().count() - 1, SMALL)
    }

    /// What the label covers if its middle is here.
    fn frame(&self, middle: [f64; 2]) -> Frame {
        Frame::around(middle, [0.5 * (text_width(1, SMALL) + self.excess()), HALF])
    }

    /// Where the middle of the label may be: the usual place, above and to the right, is the first one.
    fn places(&self) -> Vec<[f64; 2]> {
        let Frame { from, to } = self.dots;
        let beside = BESIDE + 0.5 * self.excess();
        let [left, right] = [from[0] - beside, to[0] + beside];
        let middle = [0, 1].map(|axis| 0.5 * (from[axis] + to[axis]));
        let near = [
            [right, from[1] - BESIDE],
            [right, to[1] + BESIDE],
            [left, from[1] - BESIDE],
            [left, to[1] + BESIDE],
            [right + FREE, middle[1]],
            [left - FREE, middle[1]],
            [middle[0], from[1] - ABOVE],
            [middle[0], to[1] + ABOVE],
        ];
        // The same, one label farther away.
        let far = [-2.0 * HALF, 2.0 * HALF].map(|down| near.map(|[x, y]| [x, y + down]));
        near.into_iter().chain(far.into_iter().flatten()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame {
        from: [0.0; 2],
        to: [400.0, 300.0],
    };

    fn texts(labels: &[Option<Label>]) -> Vec<&str> {
        let labels = labels.iter().flatten();
        labels.map(|label| label.text.as_str()).collect()
    }

    /// What the labels cover.
    fn frames(dots: &[Vec<[f64; 2]>]) -> Vec<Frame> {
        let labels = place(dots, FRAME);
        let both = labels.iter().flatten().zip(dots.iter().flatten());
        both.filter_map(|(label, dot)| {
            let Label { text, offset } = label.as_ref()?;
            let middle = [0, 1].map(|axis| dot[axis] + offset[axis]);
            let half = 0.5 * text_width(text.chars().count(), SMALL);
            Some(Frame::around(middle, [half, HALF]))
        })
        .collect()
    }

    #[test]
    fn labels_with_room_are_above_and_to_the_right() {
        let labels = place(&[vec![[50.0, 50.0], [80.0, 60.0]]], FRAME);
        for (label, text) in labels[0].iter().zip(["1", "2"]) {
            let label = label.as_ref().unwrap();
            assert_eq!((label.text.as_str(), label.offset), (text, [9.0, -9.0]));
        }
    }

    #[test]
    fn events_at_one_place_have_one_label() {
        let at = |places: &[f64]| vec![places.iter().map(|x| [*x, 50.0]).collect::<Vec<_>>()];
        let labels = |places| place(&at(places), FRAME);
        let [near] = &labels(&[50.0, 53.0, 56.0, 90.0, 120.0, 120.0])[..] else {
            panic!("one curve");
        };
        assert_eq!(texts(near), ["1–3", "4", "5, 6"]);
        assert!(near[0].is_none() && near[2].is_some());
        // A branch that turns back.
        assert_eq!(texts(&labels(&[50.0, 90.0, 51.0])[0]), ["2", "1, 3"]);
    }

    #[test]
    fn curves_at_one_place_have_one_label() {
        let curve = vec![[50.0, 50.0], [120.0, 60.0]];
        let mut other = curve.clone();
        other[1][1] = 200.0;
        let labels = place(&[curve, other], FRAME);
        assert_eq!(texts(&labels[0]), ["2"]);
        assert_eq!(texts(&labels[1]), ["1", "2"]);
    }

    #[test]
    fn labels_do_not_overlap_nor_leave_the_frame() {
        for distance in [4.0, 8.0, 11.0, 15.0] {
            let low = vec![[6.0, 299.0], [6.0 + distance, 299.0], [200.0, 100.0]];
            let high = vec![[6.0, 295.0], [6.0 + distance, 290.0], [203.0, 104.0]];
            let frames = frames(&[low, high]);
            assert!(frames.len() >= 4);
            for (index, one) in frames.iter().enumerate() {
                assert!(FRAME.contains(one), "{distance}: {one:?}");
                let mut others = frames[..index].iter();
                assert!(!others.any(|other| one.meets(other)), "{distance}");
            }
        }
    }
}
