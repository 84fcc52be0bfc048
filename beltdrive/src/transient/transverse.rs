//! Motion of the spans across the drive: what is stated of it.

/// Motion of the spans across, as strings that move along themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Transverse {
    /// Damping `c_w` of the motion of the belt across, per length, N·s/m²; not negative.
    pub damping: f64,
    /// Acceleration of gravity in the plane of the drive, m/s². It acts across the spans only.
    pub gravity: [f64; 2],
    /// How each span is plucked at time 0; span i leaves pulley i.
    pub plucks: Vec<Option<Pluck>>,
    /// Run-out of the rim of each pulley, in belt order.
    pub run_outs: Vec<Option<RunOut>>,
}

impl Transverse {
    /// Motion of the spans of a drive with so many pulleys without anything that excites it but the belt itself.
    #[must_use]
    pub fn free(pulleys: usize) -> Self {
        Self {
            damping: 0.0,
            gravity: [0.0; 2],
            plucks: vec![None; pulleys],
            run_outs: vec![None; pulleys],
        }
    }
}

/// A shape of a span at time 0, which then does not move across: w = a sin(n π x/ℓ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pluck {
    /// Largest displacement a, m; positive away from the inside of the loop.
    pub amplitude: f64,
    /// Number n of half waves; positive.
    pub mode: usize,
}

/// The rim of a pulley is out of round: where the belt leaves it, it stands a cos(n θ) further out, with the angle θ
/// by which the pulley has turned since time 0. Eccentricity is a run-out of order 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOut {
    /// Amplitude a, m; not negative.
    pub amplitude: f64,
    /// Number n of waves round the rim; positive.
    pub order: usize,
}

/// What moves the spans of a drive that is laid out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Across {
    /// `c_w`, N·s/m².
    pub(crate) damping: f64,
    /// The spans.
    pub(crate) spans: Vec<SpanAcross>,
}

/// What moves a span.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpanAcross {
    /// Acceleration of gravity away from the inside of the loop, m/s².
    pub(crate) gravity: f64,
    /// What moves its ends.
    pub(crate) ends: [End; 2],
}

/// What moves an end of a span across: a cos(n (θ + φ)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// The pulley at the end.
    pub(crate) pulley: usize,
    /// a, m; negative where the pulley is outside the loop.
    pub(crate) amplitude: f64,
    /// n.
    pub(crate) order: f64,
    /// Angle φ from here to where the belt leaves the pulley, rad.
    pub(crate) ahead: f64,
}

impl End {
    /// Displacement in m, its velocity and its acceleration, at an angle, a speed and a rate of speed of the pulley.
    pub(crate) fn motion(&self, angle: f64, speed: f64, change: f64) -> [f64; 3] {
        let (sine, cosine) = (self.order * (angle + self.ahead)).sin_cos();
        let [slope, curve] = [-self.order * sine, -self.order * self.order * cosine];
        [
            self.amplitude * cosine,
            self.amplitude * slope * speed,
            self.amplitude * (curve * speed * speed + slope * change),
        ]
    }
}
