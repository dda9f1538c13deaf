//! Files a simulation leaves: ParaView series, tables, plots, checkpoints, progress.
