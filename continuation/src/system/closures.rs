//! What systems given by closures have in common.

use std::sync::Arc;

/// Residual: states x, all parameters p, n values G.
type Residual = Arc<dyn Fn(&[f64], &[f64], &mut [f64]) + Send + Sync>;

/// What must be said before there is a second parameter.
const SECOND: &str = "the second parameter is named by with_second";

/// n equations G(x, p) = 0 for n states x, with values of all parameters p, one of which is λ and one
/// may be μ.
#[derive(Clone)]
pub(crate) struct Closures {
    pub(crate) states: usize,
    pub(crate) parameters: Vec<f64>,
    pub(crate) lambda: usize,
    second: Option<usize>,
    pub(crate) bounds: [f64; 2],
    residual: Residual,
}

impl Closures {
    /// # Panics
    /// If there is no parameter of the number `lambda`.
    #[track_caller]
    pub(crate) fn new(
        states: usize,
        parameters: &[f64],
        lambda: usize,
        residual: impl Fn(&[f64], &[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Self {
        let count = parameters.len();
        assert!(
            lambda < count,
            "parameter {lambda} is to vary, but there are {count}, numbered from 0"
        );
        Self {
            states,
            parameters: parameters.to_vec(),
            lambda,
            second: None,
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
            residual: Arc::new(residual),
        }
    }

    /// Names the second parameter.
    ///
    /// # Panics
    /// If there is no parameter of that number.
    #[track_caller]
    pub(crate) fn name_second(&mut self, second: usize) {
        let count = self.parameters.len();
        assert!(
            second < count,
            "parameter {second} is to vary, too, but there are {count}, numbered from 0"
        );
        self.second = Some(second);
    }

    /// The states of a point, whose λ is made the value of its parameter.
    pub(crate) fn read<'z>(&mut self, z: &'z [f64]) -> &'z [f64] {
        self.parameters[self.lambda] = z[self.states];
        &z[..self.states]
    }

    /// G at a point.
    pub(crate) fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        let x = self.read(z);
        (self.residual)(x, &self.parameters, g);
    }

    /// The rates of states and parameters along a direction, whose last number is the rate of μ if it has
    /// one more than there are unknowns.
    pub(crate) fn rates<'d>(&self, direction: &'d [f64]) -> (&'d [f64], Vec<f64>) {
        let (states, rest) = direction.split_at(self.states);
        let mut parameters = vec![0.0; self.parameters.len()];
        parameters[self.lambda] = rest[0];
        if let (Some(second), Some(rate)) = (self.second, rest.get(1)) {
            parameters[second] = *rate;
        }
        (states, parameters)
    }

    /// The second parameter μ.
    ///
    /// # Panics
    /// If none was named.
    pub(crate) fn second(&self) -> f64 {
        self.parameters[self.second.expect(SECOND)]
    }

    /// Changes the second parameter.
    ///
    /// # Panics
    /// If none was named.
    pub(crate) fn set_second(&mut self, value: f64) {
        self.parameters[self.second.expect(SECOND)] = value;
    }
}
