//! A flat belt on the rim of a pulley, in closed form.

pub(crate) mod contact;
pub(crate) mod profile;
pub(crate) mod quadrature;
pub(crate) mod traction;
pub(crate) mod zone;
