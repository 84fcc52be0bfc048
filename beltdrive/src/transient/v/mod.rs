//! Drives with V-belts in time: the belt sinks into the grooves and slips in them along two directions.
//!
//! The belt flows through a fixed mesh along the pitch line, arcs σ = R φ and spans. In a groove it lies at r = R − x,
//! and a piece dσ of the pitch line has ds = g dσ of belt, with v its velocity along itself:
//!
//! ```text
//! length     g² = (r/R)² + x_σ²       cos θ = r/(R g)     sin θ = −x_σ/g        g = 1, x = 0 on the spans
//! mass       ∂a/∂t + ∂(ρ v)/∂σ = 0                        a = ρ g: unstretched belt per dσ,  λ = 1/ρ
//! momentum   m ρ g v_t + m ρ v (g_t + v_σ) = T_σ − g (t cos θ − n sin θ)        T = EA (λ − 1) + c_d λ v_σ/g
//! depth      (F sin θ)_σ = F cos θ/R − g n                F = EA (λ − 1) − m ρ v²,   x = 0 at both ends of the arc
//! bristles   ∂B/∂t + (v/g) ∂B/∂σ = κ (e − |e| B/μ)        B = 0 at the entry
//! slip       e_t = v cos θ − ω r      e_w = (v sin θ − x_t)/cos β
//! pressure   p = (k x/2)/(cos β + B_w sin β)              p = 0 where x < 0
//! loads      n = 2 p (sin β − B_w cos β) outward,         t = 2 p B_t against the motion of the pulley
//! pulleys    J dω/dt = ∫ t r ds + M
//! ```
//!
//! What stands still in them is the steady state of `vbelt` at any inclination below 90°: with G = m ρ v and F = T − G v
//! momentum is dF/ds = t cos θ − n sin θ, depth is dθ/ds = cos θ/r − (n cos θ + t sin θ)/F. The bristles are carried with
//! v/g, not with v: the belt of the example of Kim (2009) is 2 % shorter at its depth than on the pitch circle.
//!
//! **Radial motion** has no inertia here: x is in balance at every instant. Momentum has the term m ρ v `g_t` in return,
//! without which the work of m ρ v² on a belt that sinks would be missing; so the kinetic energy is ½ m v² per unstretched
//! length, and
//!
//! ```text
//! work of the axles = Δ(kinetic + strain energy) + ∫∫ c_d λ v_σ²/g + ∫∫ 2 p (B·e) ds + ∫∫ k x tan β (x_t − v sin θ) ds
//! ```
//!
//! damping, friction in both directions, transverse compression, is an identity of the equations on the mesh, not only
//! of those of the continuum: the ledger misses what the steps of time miss.
//!
//! **Steps** are explicit. x follows from amount, velocity and bristles by Newton's method on a tridiagonal system; its
//! rate, which bends the bristles, from the derivative of the balance with time, in which the bristles stand with their
//! own rate. They hold the belt in the groove much more stiffly (2 p κ) than the groove does (k tan β), so that a
//! difference quotient of x in their rate would ask for steps of a fraction of 1/(2 p κ); solved for together they ask
//! for none: what is left is waves, and the rate κ |e|/μ at which bristles saturate.
//!
//! **Contact ends** do not move: they are held where the steady state of the drive has them, not on the tangent points
//! of the pitch circles, outside of which the belt meets the groove. So nothing is lost in that steady state; in others
//! the belt has a kink where span and arc meet, which a pin without friction holds, and what that costs grows with
//! the distance of the load: on the drive of Kim (2009) with bristles at 0.8 and 0.5 of its torque, the tight tension is 1.7
//! and 3.5 N above that of the steady state with the same belt (733 and 670 N), the speed of the driven pulley 0.011 and
//! 0.024 rad/s below it.

pub(crate) mod initial;
pub(crate) mod radial;
pub(crate) mod rates;
pub(crate) mod sinking;
pub(crate) mod state;
pub(crate) mod system;
#[cfg(test)]
mod tests;
mod told;
