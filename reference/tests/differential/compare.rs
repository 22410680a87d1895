//! One program in the engine and in the reference, row by row.

use std::collections::{BTreeMap, BTreeSet};

use crate::twins::{Tables, Twins};
use grafcet::bound::Rounds;
use grafcet::trace::Columns;
use grafcet_compiler::application::{Application, Unit};
use grafcet_compiler::diagnostic::Level;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, ast, compile, parse};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Bit, Compiled, Number, Slot};
use grafcet_reference::{Machine, Program, Qualified};

use crate::outcome::{Failure, Tally};
use crate::render::{LIBRARY, Text};
use crate::stimulus::{PowerCycle, Scan, full_name};
use crate::tool;

/// The syntax trees of the main file and the library.
pub struct Trees {
    main: ast::File,
    libraries: Vec<ast::File>,
}

impl Trees {
    /// Of a program that is known to be well-formed.
    pub fn of(text: &Text) -> Self {
        let tree = |file, text: &str| parse(FileId(file), text, &mut Vec::new());
        Trees {
            main: tree(0, &text.main),
            libraries: text.library.iter().map(|text| tree(1, text)).collect(),
        }
    }

    pub fn program(&self) -> Program<'_> {
        Program::new(&self.main, &self.libraries)
    }
}

/// Compiles a program.
pub fn application(text: &Text) -> Result<Application, Failure> {
    let library = |path: &str| match &text.library {
        Some(library) if path == LIBRARY => Ok(library.clone()),
        _ => Err(std::io::ErrorKind::NotFound.into()),
    };
    let compilation = compile("random.grafcet", &text.main, &library, Target::Host);
    if let Some(application) = compilation.application {
        return match application.controller.tables.program().unsoundness() {
            None => Ok(application),
            Some(fault) => Err(Failure::Refused(format!("unsound tables: {fault:?}"))),
        };
    }
    let mut errors = compilation.diagnostics;
    errors.retain(|diagnostic| diagnostic.level() == Level::Error);
    let errors = render(&errors, &compilation.sources, Style::default());
    Err(Failure::Refused(errors))
}

/// Runs a program in both and compares every row.
pub fn compare(text: &Text, stimulus: &[Scan]) -> Result<Tally, Failure> {
    let run = || Ok(traced(text, stimulus)?.0);
    std::panic::catch_unwind(run).unwrap_or_else(|panic| {
        let message = panic
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Err(Failure::Panic(message.unwrap_or_default()))
    })
}

/// The same, with the rows of the trace on which they agree, the header first; panics are not caught.
pub fn traced(text: &Text, stimulus: &[Scan]) -> Result<(Tally, Vec<Vec<String>>), Failure> {
    let application = application(text)?;
    let trees = Trees::of(text);
    Comparison::run(&application, &trees.program(), stimulus)
}

/// One program, twice.
struct Comparison<'a> {
    unit: &'a Unit,
    slots: BTreeMap<&'a str, Slot>,
    columns: Columns<'a>,
    reference: &'a Program<'a>,
    inputs: BTreeMap<String, Qualified<'a>>,
    parameters: BTreeMap<String, Qualified<'a>>,
}

impl<'a> Comparison<'a> {
    fn run(
        application: &'a Application,
        reference: &'a Program<'a>,
        stimulus: &[Scan],
    ) -> Result<(Tally, Vec<Vec<String>>), Failure> {
        let unit = &application.controller;
        let named = |names: Vec<Qualified<'a>>| -> BTreeMap<String, Qualified<'a>> {
            let names = names.into_iter();
            names.map(|name| (full_name(name), name)).collect()
        };
        let slots = unit.symbols.variables.iter();
        let comparison = Comparison {
            unit,
            slots: slots.map(|v| (v.name.as_str(), v.slot)).collect(),
            columns: Columns::of(unit),
            inputs: named(reference.inputs()),
            parameters: named(reference.parameters()),
            reference,
        };
        let engine: Vec<String> = comparison.columns.header().map(str::to_owned).collect();
        let header = reference.header();
        if engine != header {
            let reference = header;
            return Err(Failure::Header { engine, reference });
        }
        let mut rows = vec![header];
        let tally = comparison.compare(stimulus, &mut rows)?;
        if let Some(csv) = tool::csv(stimulus, reference.period_ms) {
            tool::compare(application, &csv, &rows)?;
        }
        Ok((tally, rows))
    }

    /// Runs both and keeps the rows of the trace.
    fn compare(&self, stimulus: &[Scan], rows: &mut Vec<Vec<String>>) -> Result<Tally, Failure> {
        let program = self.unit.tables.program();
        let actors = (0..program.actor_rows()).map(|row| program.actors_of(row));
        let actors: Vec<_> = actors.collect();
        let tables = Tables::of(program, &actors);
        let mut engine = Twins::new(&tables);
        let mut machine = Machine::new(self.reference);
        let mut inputs: BTreeMap<&String, i32> = self.inputs.keys().map(|name| (name, 0)).collect();
        let rounds = Rounds::of_program(&program);
        let mut seen = Seen {
            settles: usize::from(matches!(rounds, Rounds::Settle { .. })),
            ..Seen::default()
        };
        let mut next_ms = 0;
        for (number, scan) in stimulus.iter().enumerate() {
            if let Some(cycle) = &scan.power_cycle {
                let kept = self.retained(&machine, cycle);
                machine = Machine::new(self.reference);
                engine = Twins::new(&tables);
                for (name, value) in kept {
                    let full = full_name(name);
                    let taken = engine.restore(self.slots[full.as_str()], value);
                    if machine.restore(name, value) != taken {
                        return Err(Failure::Restored(full));
                    }
                }
                machine.set_recovered(cycle.recovered);
                engine.set_recovered(cycle.recovered);
                next_ms = 0;
            }
            if let Some(overruns) = scan.overruns {
                machine.set_overruns(overruns);
                engine.set_overruns(overruns.unsigned_abs());
            }
            for (name, value) in &scan.given {
                if let Some((input, _)) = self.inputs.get_key_value(name) {
                    inputs.insert(input, *value);
                } else if let Some(parameter) = self.parameters.get(name) {
                    machine.set(*parameter, *value);
                    engine.set_parameter(self.slots[name.as_str()], *value);
                }
            }
            for (name, value) in &inputs {
                machine.set(self.inputs[*name], *value);
                engine.sample(self.slots[name.as_str()], *value);
            }
            if next_ms == 0 {
                engine.start();
                machine.scan(0);
                next_ms = self.reference.period_ms;
            } else {
                let time_ms = next_ms + (scan.periods - 1) * self.reference.period_ms;
                seen.idle += usize::from(!engine.scan(time_ms));
                machine.scan(time_ms);
                next_ms = time_ms + self.reference.period_ms;
            }
            if machine.rounds() > rounds.most() {
                return Err(Failure::Rounds {
                    scan: number,
                    took: machine.rounds(),
                    bound: rounds.most(),
                });
            }
            seen.longest |= machine.rounds() == rounds.most();
            seen.look(engine.first());
            rows.push(machine.row());
            self.same_rows(number, engine.first(), &machine)?;
            if !engine.agree() {
                return Err(Failure::Walks { scan: number });
            }
        }
        Ok(seen.tally(stimulus.len(), engine.first()))
    }

    /// What is stored when power comes back.
    fn retained(&self, machine: &Machine<'a>, cycle: &PowerCycle) -> Vec<(Qualified<'a>, i32)> {
        let names = self.reference.retained().into_iter();
        let stored = names.filter_map(|name| {
            let strange = cycle
                .strange
                .iter()
                .find(|(strange, _)| *strange == full_name(name));
            let value = machine.value(name)?.number();
            Some((name, strange.map_or(value, |(_, value)| *value)))
        });
        stored.collect()
    }

    fn same_rows(
        &self,
        scan: usize,
        engine: &Engine<impl Compiled, impl Memory>,
        machine: &Machine<'_>,
    ) -> Result<(), Failure> {
        let images = engine.images();
        let time_ms = machine.time_ms();
        let cells = self.columns.row(time_ms, images).zip(machine.row());
        let differences: Vec<String> = self
            .columns
            .header()
            .zip(cells)
            .filter(|(_, (engine, reference))| engine != reference)
            .map(|(name, (engine, reference))| format!("{name}: `{engine}`, `{reference}`"))
            .collect();
        if differences.is_empty() {
            Ok(())
        } else {
            Err(Failure::Row { scan, differences })
        }
    }
}

/// What happened at least once.
#[derive(Default)]
struct Seen {
    fired: BTreeSet<usize>,
    active: BTreeSet<(usize, usize)>,
    forced: usize,
    unstable: usize,
    idle: usize,
    settles: usize,
    longest: bool,
}

impl Seen {
    fn look(&mut self, engine: &Engine<impl Compiled, impl Memory>) {
        self.fired.extend(engine.fired());
        for graph in 0..engine.program().graphs.len() {
            let steps = engine.active_steps(graph);
            self.active.extend(steps.map(|step| (graph, step)));
            self.forced += usize::from(engine.graph_forced(graph));
        }
        self.unstable += usize::from(engine.bit(Bit::UNSTABLE));
    }

    fn tally(&self, scans: usize, engine: &Engine<impl Compiled, impl Memory>) -> Tally {
        Tally {
            programs: 1,
            scans,
            transitions: engine.program().transitions.len(),
            fired: self.fired.len(),
            steps: engine.program().steps.len(),
            active: self.active.len(),
            forced: self.forced,
            unstable: self.unstable,
            idle: self.idle,
            settles: self.settles,
            longest: usize::from(self.longest) * self.settles,
            with_faults: usize::from(engine.number(Number::ARITHMETIC_FAULTS) > 0),
        }
    }
}
