//! Material-point solvers: transfers between particles and grid, explicit and quasi-static steps.
