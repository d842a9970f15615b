//! Simulations that exist for a figure.
