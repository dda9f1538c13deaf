//! The framework, tested with studies that only exist here.

#[cfg(test)]
mod combinations;
#[cfg(test)]
mod command_line;
#[cfg(test)]
mod fake;
#[cfg(test)]
mod rows;
