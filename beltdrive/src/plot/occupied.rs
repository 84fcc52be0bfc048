//! What is covered on a sheet, and where there is room for labels.

use super::sheet::Spot;

/// What a leader pays for every line it crosses, in px of distance: one farther label is better.
const CROSSING: f64 = 60.0;

/// A rectangle on the sheet, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// Left upper corner.
    pub(super) from: Spot,
    /// Right lower corner.
    pub(super) to: Spot,
}

impl Frame {
    /// The rectangle round a middle, with half its width and height.
    pub(super) fn around(middle: Spot, half: Spot) -> Self {
        Self {
            from: middle - half,
            to: middle + half,
        }
    }

    /// Its width and height.
    pub(super) fn size(&self) -> Spot {
        self.to - self.from
    }

    /// Its middle.
    pub(super) fn middle(&self) -> Spot {
        0.5 * (self.from + self.to)
    }

    /// Whether two rectangles overlap.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.from < other.to && other.from < self.to
    }

    /// Whether another one lies inside.
    pub(super) fn contains(&self, other: &Self) -> bool {
        self.from <= other.from && other.to <= self.to
    }

    /// Its point nearest to a place.
    pub(super) fn nearest(&self, place: Spot) -> Spot {
        place.sup(&self.from).inf(&self.to)
    }

    /// Whether a line passes through it when it is made larger on every side.
    fn is_cut(&self, [start, end]: [Spot; 2], room: f64) -> bool {
        let mut part = [0.0_f64, 1.0];
        for axis in 0..2 {
            let (low, high) = (self.from[axis] - room, self.to[axis] + room);
            let across = end[axis] - start[axis];
            if across == 0.0 {
                if start[axis] <= low || start[axis] >= high {
                    return false;
                }
            } else {
                let [one, other] = [low, high].map(|side| (side - start[axis]) / across);
                part = [part[0].max(one.min(other)), part[1].min(one.max(other))];
            }
        }
        part[0] < part[1]
    }
}

/// Something that no label may cover, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// A label or a marker.
    Box(Frame),
    /// A disc: its middle and radius.
    Disc(Spot, f64),
    /// A line: its ends and half its width.
    Line([Spot; 2], f64),
}

impl Shape {
    /// Whether a rectangle covers a part of it.
    pub(super) fn meets(&self, frame: &Frame) -> bool {
        match *self {
            Self::Box(other) => frame.meets(&other),
            Self::Disc(middle, radius) => (frame.nearest(middle) - middle).norm() < radius,
            Self::Line(ends, half) => frame.is_cut(ends, half),
        }
    }

    /// What a leader pays for passing over it; `None` where it may not.
    fn toll(&self, leader: [Spot; 2]) -> Option<f64> {
        match *self {
            Self::Box(frame) => (!frame.is_cut(leader, 0.0)).then_some(0.0),
            Self::Disc(middle, radius) => (distance_to(leader, middle) >= radius).then_some(0.0),
            Self::Line(ends, _) if crosses(ends, leader) => Some(CROSSING),
            Self::Line(..) => Some(0.0),
        }
    }
}

/// A place for a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// What the label covers.
    pub(super) frame: Frame,
    /// A line that leads to the label from what it belongs to, if it is not beside it.
    pub(super) leader: Option<[Spot; 2]>,
    /// How bad the place is, px.
    pub(super) cost: f64,
}

/// What is covered on a part of the sheet.
#[derive(Clone, Debug)]
pub(super) struct Occupied {
    /// The part of the sheet that labels stay in.
    pub(super) sheet: Frame,
    /// What is there.
    pub(super) shapes: Vec<Shape>,
}

impl Occupied {
    /// The best of the places that are free, and covers it.
    pub(super) fn place(&mut self, places: impl Iterator<Item = Place>) -> Option<Place> {
        let free = places.filter_map(|place| {
            let is_free = self.sheet.contains(&place.frame)
                && !self.shapes.iter().any(|shape| shape.meets(&place.frame));
            let tolls = self.shapes.iter();
            let tolls = tolls.map(|shape| place.leader.map_or(Some(0.0), |line| shape.toll(line)));
            let cost = place.cost + tolls.sum::<Option<f64>>()?;
            is_free.then_some(Place { cost, ..place })
        });
        let best = free.min_by(|one, other| one.cost.total_cmp(&other.cost))?;
        self.cover(&best);
        Some(best)
    }

    /// Covers a place with its leader.
    pub(super) fn cover(&mut self, place: &Place) {
        self.shapes.push(Shape::Box(place.frame));
        let leader = place.leader.map(|ends| Shape::Line(ends, 1.0));
        self.shapes.extend(leader);
    }
}

/// Distance of a place from a line, px.
pub(super) fn distance_to([start, end]: [Spot; 2], place: Spot) -> f64 {
    let along = end - start;
    let square = along.norm_squared();
    let part = if square > 0.0 {
        ((place - start).dot(&along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (start + part * along - place).norm()
}

fn crosses(one: [Spot; 2], other: [Spot; 2]) -> bool {
    let side = |[start, end]: [Spot; 2], place: Spot| (end - start).perp(&(place - start));
    let parts = |line: [Spot; 2], ends: [Spot; 2]| side(line, ends[0]) * side(line, ends[1]) <= 0.0;
    parts(one, other) && parts(other, one)
}

#[cfg(test)]
mod tests {
    use super::super::sheet::spot;
    use super::*;

    fn line(x: f64, y: f64, to_x: f64, to_y: f64) -> [Spot; 2] {
        [spot(x, y), spot(to_x, to_y)]
    }

    #[test]
    fn shapes_meet_where_they_overlap() {
        let frame = Frame {
            from: spot(10.0, 10.0),
            to: spot(30.0, 20.0),
        };
        let beside = Frame::around(spot(35.0, 15.0), spot(6.0, 1.0));
        let below = Frame::around(spot(20.0, 25.0), spot(6.0, 1.0));
        let shapes = [
            (Shape::Disc(spot(35.0, 15.0), 5.5), true),
            (Shape::Disc(spot(35.0, 15.0), 4.5), false),
            // Near the corner, but not in it.
            (Shape::Disc(spot(33.0, 24.0), 4.9), false),
            (Shape::Line(line(0.0, 0.0, 40.0, 30.0), 1.0), true),
            (Shape::Line(line(0.0, 22.0, 40.0, 22.0), 1.0), false),
            (Shape::Line(line(0.0, 22.0, 40.0, 22.0), 3.0), true),
            (Shape::Line(line(40.0, 0.0, 40.0, 30.0), 1.0), false),
            (Shape::Line(line(0.0, 15.0, 5.0, 15.0), 1.0), false),
            (Shape::Box(beside), true),
            (Shape::Box(below), false),
        ];
        for (shape, meets) in shapes {
            assert_eq!(shape.meets(&frame), meets, "{shape:?}");
        }
    }

    #[test]
    fn the_best_free_place_is_taken() {
        let mut occupied = Occupied {
            sheet: Frame::around(spot(50.0, 50.0), spot(50.0, 50.0)),
            shapes: vec![Shape::Disc(spot(50.0, 50.0), 10.0)],
        };
        let places = [(50.0, 0.0), (95.0, 1.0), (75.0, 3.0), (20.0, 2.0)].map(|(x, cost)| Place {
            frame: Frame::around(spot(x, 50.0), spot(8.0, 5.0)),
            leader: None,
            cost,
        });
        let mut taken = || {
            let place = occupied.place(places.into_iter());
            place.map(|place| place.frame.middle().x)
        };
        assert_eq!([taken(), taken(), taken()], [Some(20.0), Some(75.0), None]);
    }

    #[test]
    fn leaders_go_round_discs_and_cross_lines_only_where_they_must() {
        let leader = line(50.0, 50.0, 50.0, 0.0);
        let barrier = Shape::Line(line(0.0, 30.0, 100.0, 30.0), 1.0);
        assert_eq!(barrier.toll(leader), Some(CROSSING));
        assert_eq!(Shape::Disc(spot(45.0, 20.0), 6.0).toll(leader), None);
        assert_eq!(Shape::Disc(spot(45.0, 20.0), 4.0).toll(leader), Some(0.0));
        let label = Frame::around(spot(50.0, 20.0), spot(5.0, 5.0));
        assert_eq!(Shape::Box(label).toll(leader), None);
    }
}
