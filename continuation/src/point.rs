//! A point of a branch.

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// All unknowns (x, λ), n + 1 numbers.
    pub z: Vec<f64>,
    /// Unit tangent in the direction of travel, in the norm of the arclength, n + 1 numbers. At
    /// labelled points exact, else from the last linearisation near the point.
    pub tangent: Vec<f64>,
    /// Arclength from the start of the trace, along the cubic through both points and tangents of
    /// every step.
    pub arclength: f64,
    /// What kind of point it is.
    pub kind: Kind,
    /// Unit tangent of the other branch, at branch points that have one.
    pub other: Option<Vec<f64>>,
    /// Whether a limit point or branch point is only indicated on a very short step: its defining
    /// conditions could not be verified, for instance because of noise in G or because more than two
    /// curves cross. Its place is known to about 1e-5 in the arclength norm.
    #[cfg_attr(feature = "serde", serde(default))]
    pub approximate: bool,
    /// Discretisation error of a labelled point, where the system can be refined.
    pub error: Option<DiscretisationError>,
}

impl Point {
    /// The parameter λ.
    pub fn lambda(&self) -> f64 {
        self.z[self.z.len() - 1]
    }

    /// The unknowns x without the parameter.
    pub fn x(&self) -> &[f64] {
        &self.z[..self.z.len() - 1]
    }
}

/// What kind of point of a branch it is. All but `Regular` are labelled points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Kind {
    /// The first point.
    Start,
    /// A step.
    Regular,
    /// Limit point (fold): λ turns back. Beside a branch point it is told from that if the unit tangent
    /// there has a λ component of more than 1e-8 of the range of λ; of 1e-5 if G has a kink or noise.
    LimitPoint,
    /// Branch point: another branch crosses. Kinks of G do not matter at a distance above 3e-6 in the
    /// arclength norm, or 1e-4 for [`other`](Point::other) if the Jacobian is found by differences.
    BranchPoint,
    /// Cusp of a curve of limit points.
    Cusp,
    /// Zero of an event function, by its index.
    Event(usize),
    /// A target value of λ.
    Target,
    /// A bound of λ: the last point.
    Bound,
    /// The first point again: the last one of a closed curve.
    Closed,
}

/// How much a labelled point moves when the system is discretised finer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DiscretisationError {
    /// |change of λ|, in units of λ.
    pub lambda: f64,
    /// Largest |change| of the unknowns x, relative to the size of their groups.
    pub states: f64,
}
