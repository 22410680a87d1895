//! What a person at a terminal gets from `grafcet`: output, errors and exit codes.

mod check;
mod desk;
mod every;
mod test;
mod trace;
