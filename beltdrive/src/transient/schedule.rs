//! A quantity that is given over time.

/// A number over time: straight lines between points, constant before the first and after the last one. Two points
/// at one time are a jump. A sine may be added at all times.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// Times in s that do not fall, with the values there.
    points: Vec<[f64; 2]>,
    /// The sine, if there is one.
    pulsation: Option<Pulsation>,
}

/// A sine over time t, a sin ω t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulsation {
    /// Its amplitude a, in the unit of what it is added to; not negative.
    pub amplitude: f64,
    /// Its angular frequency ω, rad/s; positive.
    pub angular_frequency: f64,
}

impl Schedule {
    /// The same value at all times.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self {
            points: vec![[0.0, value]],
            pulsation: None,
        }
    }

    /// A jump from one value to another at a time in s.
    #[must_use]
    pub fn step(at: f64, [before, after]: [f64; 2]) -> Self {
        Self {
            points: vec![[at, before], [at, after]],
            pulsation: None,
        }
    }

    /// A straight line from one value to another between two times in s.
    #[must_use]
    pub fn ramp([from, to]: [f64; 2], [before, after]: [f64; 2]) -> Self {
        Self {
            points: vec![[from, before], [to, after]],
            pulsation: None,
        }
    }

    /// A value that another one takes the place of between two times in s.
    #[must_use]
    pub fn pulse([from, to]: [f64; 2], [usual, raised]: [f64; 2]) -> Self {
        Self {
            points: vec![[from, usual], [from, raised], [to, raised], [to, usual]],
            pulsation: None,
        }
    }

    /// Straight lines between points of time in s and value; `None` if there is no point, if times fall, or if a
    /// number is not finite.
    #[must_use]
    pub fn table(points: Vec<[f64; 2]>) -> Option<Self> {
        let schedule = Self {
            points,
            pulsation: None,
        };
        schedule.is_in_order().then_some(schedule)
    }

    /// Whether there are points, with finite numbers and times that do not fall.
    pub(crate) fn is_in_order(&self) -> bool {
        let rises = self.points.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
        let mut numbers = self.points.iter().flatten();
        rises && numbers.all(|number| number.is_finite()) && !self.points.is_empty()
    }

    /// The same with a sine added.
    #[must_use]
    pub fn pulsating(mut self, pulsation: Pulsation) -> Self {
        self.pulsation = Some(pulsation);
        self
    }

    /// The sine that is added, if there is one.
    pub fn pulsation(&self) -> Option<Pulsation> {
        self.pulsation
    }

    /// The points, times in s with the values there, without a sine.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The value at a time in s; at a jump that after it.
    pub fn at(&self, time: f64) -> f64 {
        self.on(self.line(time), time)[0]
    }

    /// The first time in s at which the value jumps.
    pub fn first_jump(&self) -> Option<f64> {
        let mut pairs = self.points.windows(2);
        let jumps = |pair: &&[[f64; 2]]| pair[0][0] == pair[1][0] && pair[0][1] != pair[1][1];
        pairs.find(jumps).map(|pair| pair[0][0])
    }

    /// The first corner after a time, s.
    pub(crate) fn next_corner(&self, time: f64) -> f64 {
        let mut times = self.points.iter().map(|point| point[0]);
        times.find(|&corner| corner > time).unwrap_or(f64::INFINITY)
    }

    /// The straight line that holds at a time in s and just after it: the number of points passed.
    pub(crate) fn line(&self, time: f64) -> usize {
        self.points.partition_point(|point| point[0] <= time)
    }

    /// Value and slope at a time in s on a straight line of [`Self::line`], which holds beyond its ends, with the sine.
    pub(crate) fn on(&self, line: usize, time: f64) -> [f64; 2] {
        let [value, slope] = self.on_line(line, time);
        let Some(Pulsation {
            amplitude,
            angular_frequency,
        }) = self.pulsation
        else {
            return [value, slope];
        };
        let (sine, cosine) = (angular_frequency * time).sin_cos();
        let rate = amplitude * angular_frequency;
        [value + amplitude * sine, slope + rate * cosine]
    }

    fn on_line(&self, line: usize, time: f64) -> [f64; 2] {
        let Some([start, before]) = line.checked_sub(1).map(|last| self.points[last]) else {
            return [self.points[0][1], 0.0];
        };
        match self.points.get(line) {
            Some([end, after]) => {
                let slope = (after - before) / (end - start);
                [before + slope * (time - start), slope]
            }
            None => [before, 0.0],
        }
    }
}
