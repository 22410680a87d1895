//! What the image says about itself: one line for each change of a situation and for each fault counted.
//!
//! The same calls are defmt frames on a microcontroller and printed text on a host, so arguments are formatted by
//! `defmt::Format` there and by `Display` here.

use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Bit, Compiled, Graph, Names, Number};

/// Logs what an operator should know.
macro_rules! note {
    ($($argument:tt)*) => {{
        #[cfg(target_os = "none")]
        defmt::info!($($argument)*);
        #[cfg(not(target_os = "none"))]
        $crate::boards::host::lines::print(format_args!($($argument)*));
    }};
}

/// Logs a fault that has been counted.
macro_rules! fault {
    ($($argument:tt)*) => {{
        #[cfg(target_os = "none")]
        defmt::warn!($($argument)*);
        #[cfg(not(target_os = "none"))]
        $crate::boards::host::lines::print(format_args!($($argument)*));
    }};
}

pub(crate) use {fault, note};

/// Looks at each scan and logs what it changed.
#[derive(Debug)]
pub struct Observer {
    names: &'static Names<'static>,
    arithmetic_faults: i32,
    unstable: bool,
    /// Scan 0 has been observed. The engine itself does not keep it in mind where no program reads it.
    begun: bool,
}

impl Observer {
    /// An observer of a program with these names, which has not been started.
    #[must_use]
    pub const fn new(names: &'static Names<'static>) -> Self {
        Observer {
            names,
            arithmetic_faults: 0,
            unstable: false,
            begun: false,
        }
    }

    /// Logs the changes of the latest scan.
    pub fn observe(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        let graphs = engine.program().graphs.iter().enumerate();
        for (index, graph) in graphs.filter(|(index, _)| engine.graph_changed(*index)) {
            self.log_change(engine, index, graph);
        }
        self.begun = true;
        let faults = engine.number(Number::ARITHMETIC_FAULTS);
        if faults != self.arithmetic_faults {
            self.arithmetic_faults = faults;
            fault!("arithmetic fault ({} since start)", faults);
        }
        let unstable = engine.bit(Bit::UNSTABLE);
        if unstable && !self.unstable {
            fault!("unstable: no stable situation was found in this scan");
        }
        self.unstable = unstable;
    }

    fn log_change(&self, engine: &Engine<impl Compiled, impl Memory>, index: usize, graph: &Graph) {
        let program = engine.program();
        let name = named(self.names.graphs, index);
        let mut fired = engine
            .fired()
            .filter(|transition| graph.transitions.indices().contains(transition))
            .peekable();
        if fired.peek().is_none() {
            let before = self.steps(|| engine.steps_before(index));
            let now = self.steps(|| engine.active_steps(index));
            if !self.begun {
                note!("{} starts in {}", name, now);
                return;
            }
            let manner = match (
                engine.graph_forced(index),
                program.role(graph).enclosings.len,
            ) {
                (false, _) => "",
                (true, 0) => " forced:",
                (true, _) => " enclosed:",
            };
            note!("{}{} {} -> {}", name, manner, before, now);
        }
        for transition in fired {
            let Some(row) = program.transitions.get(transition) else {
                continue;
            };
            let number = self.names.transitions.get(transition).copied().unwrap_or(0);
            let entrance = self.steps(|| program.entrance_steps(graph, row));
            let exit = self.steps(|| program.exit_steps(graph, row));
            note!("{} T{}: {} -> {}", name, number, entrance, exit);
        }
    }

    fn steps<I: Iterator<Item = usize>, F: Fn() -> I>(&self, indices: F) -> Steps<F> {
        Steps {
            names: self.names.steps,
            indices,
        }
    }
}

fn named<'n>(names: &[&'n str], index: usize) -> &'n str {
    names.get(index).copied().unwrap_or("?")
}

/// Steps in braces: `{3, E5}`.
struct Steps<F> {
    names: &'static [&'static str],
    indices: F,
}

#[cfg(target_os = "none")]
impl<I: Iterator<Item = usize>, F: Fn() -> I> defmt::Format for Steps<F> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{{");
        for (place, step) in (self.indices)().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            defmt::write!(f, "{=str}{=str}", separator, named(self.names, step));
        }
        defmt::write!(f, "}}");
    }
}

#[cfg(not(target_os = "none"))]
impl<I: Iterator<Item = usize>, F: Fn() -> I> core::fmt::Display for Steps<F> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("{")?;
        for (place, step) in (self.indices)().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            write!(f, "{separator}{}", named(self.names, step))?;
        }
        f.write_str("}")
    }
}
