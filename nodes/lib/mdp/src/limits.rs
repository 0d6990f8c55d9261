//! How large a process may be and how exact its numbers must be; checked before anything is allocated.

/// Most states.
pub const MAX_STATES: usize = 200_000;
/// Most transitions; most pairs of state and action.
pub const MAX_TRANSITIONS: usize = 20_000_000;
/// Most numbers in one table: states × actions × features.
pub const MAX_NUMBERS: usize = 100_000_000;
/// Largest discount factor: beyond a horizon of a million steps rounding would show in the tenth digit.
pub const MAX_GAMMA: f64 = 1.0 - 1e-6;
/// How far probabilities that are to sum to 1 may be off.
pub const SUM_TOLERANCE: f64 = 1e-9;
/// Largest discount factor of processes of more than [`MAX_STATES_LONG`] states, which may have to be solved by sweeps.
pub const MAX_GAMMA_LARGE: f64 = 0.9999;
/// Most states of a process whose discount factor is above [`MAX_GAMMA_LARGE`].
pub const MAX_STATES_LONG: usize = 2000;
