//! What is covered on a sheet, and where there is room for labels.

/// A place on the sheet, px.
pub(super) type Spot = [f64; 2];

/// What a leader pays for every line it crosses, in px of distance: one farther label is better.
const CROSSING: f64 = 60.0;

/// A rectangle on the sheet, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// Left and upper end.
    pub(super) from: Spot,
    /// Right and lower end.
    pub(super) to: Spot,
}

impl Frame {
    /// The rectangle round a middle, with half its width and height.
    pub(super) fn around(middle: Spot, half: Spot) -> Self {
        Self {
            from: [0, 1].map(|axis| middle[axis] - half[axis]),
            to: [0, 1].map(|axis| middle[axis] + half[axis]),
        }
    }

    /// Whether two rectangles overlap.
    pub(super) fn meets(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.from[axis] < other.to[axis] && other.from[axis] < self.to[axis])
    }

    /// Whether another one lies inside.
    pub(super) fn contains(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.from[axis] <= other.from[axis] && other.to[axis] <= self.to[axis])
    }

    /// Its point nearest to a place.
    pub(super) fn nearest(&self, place: Spot) -> Spot {
        [0, 1].map(|axis| place[axis].clamp(self.from[axis], self.to[axis]))
    }

    /// Its middle.
    pub(super) fn middle(&self) -> Spot {
        [0, 1].map(|axis| 0.5 * (self.from[axis] + self.to[axis]))
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
            Self::Disc(middle, radius) => distance(frame.nearest(middle), middle) < radius,
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

/// Distance between two places, px.
pub(super) fn distance(one: Spot, other: Spot) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

/// Distance of a place from a line, px.
pub(super) fn distance_to([start, end]: [Spot; 2], place: Spot) -> f64 {
    let along = [0, 1].map(|axis| end[axis] - start[axis]);
    let from_start = [0, 1].map(|axis| place[axis] - start[axis]);
    let square = along[0] * along[0] + along[1] * along[1];
    let dot = from_start[0] * along[0] + from_start[1] * along[1];
    let part = if square > 0.0 {
        (dot / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    distance([0, 1].map(|axis| start[axis] + part * along[axis]), place)
}

fn crosses(one: [Spot; 2], other: [Spot; 2]) -> bool {
    let side = |[start, end]: [Spot; 2], place: Spot| {
        (end[0] - start[0]) * (place[1] - start[1]) - (end[1] - start[1]) * (place[0] - start[0])
    };
    let parts = |line: [Spot; 2], ends: [Spot; 2]| side(line, ends[0]) * side(line, ends[1]) <= 0.0;
    parts(one, other) && parts(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame {
        from: [10.0, 10.0],
        to: [30.0, 20.0],
    };

    #[test]
    fn shapes_meet_where_they_overlap() {
        let shapes = [
            (Shape::Disc([35.0, 15.0], 5.5), true),
            (Shape::Disc([35.0, 15.0], 4.5), false),
            // Near the corner, but not in it.
            (Shape::Disc([33.0, 24.0], 4.9), false),
            (Shape::Line([[0.0, 0.0], [40.0, 30.0]], 1.0), true),
            (Shape::Line([[0.0, 22.0], [40.0, 22.0]], 1.0), false),
            (Shape::Line([[0.0, 22.0], [40.0, 22.0]], 3.0), true),
            (Shape::Line([[40.0, 0.0], [40.0, 30.0]], 1.0), false),
            (Shape::Line([[0.0, 15.0], [5.0, 15.0]], 1.0), false),
            (Shape::Box(Frame::around([35.0, 15.0], [6.0, 1.0])), true),
        ];
        for (shape, meets) in shapes {
            assert_eq!(shape.meets(&FRAME), meets, "{shape:?}");
        }
    }

    #[test]
    fn the_best_free_place_is_taken() {
        let mut occupied = Occupied {
            sheet: Frame::around([50.0, 50.0], [50.0, 50.0]),
            shapes: vec![Shape::Disc([50.0, 50.0], 10.0)],
        };
        let place = |x: f64, cost| Place {
            frame: Frame::around([x, 50.0], [8.0, 5.0]),
            leader: None,
            cost,
        };
        let places = [
            place(50.0, 0.0),
            place(95.0, 1.0),
            place(75.0, 3.0),
            place(20.0, 2.0),
        ];
        let taken = |occupied: &mut Occupied| {
            let place = occupied.place(places.into_iter());
            place.map(|place| place.frame.middle()[0])
        };
        assert_eq!(taken(&mut occupied), Some(20.0));
        assert_eq!(taken(&mut occupied), Some(75.0));
        assert_eq!(taken(&mut occupied), None);
    }

    #[test]
    fn leaders_go_round_discs_and_cross_lines_only_where_they_must() {
        let line = [[0.0, 30.0], [100.0, 30.0]];
        let leader = [[50.0, 50.0], [50.0, 0.0]];
        assert_eq!(Shape::Line(line, 1.0).toll(leader), Some(CROSSING));
        assert_eq!(Shape::Disc([45.0, 20.0], 6.0).toll(leader), None);
        assert_eq!(Shape::Disc([45.0, 20.0], 4.0).toll(leader), Some(0.0));
        assert_eq!(
            Shape::Box(Frame::around([50.0, 20.0], [5.0, 5.0])).toll(leader),
            None
        );
    }
}
