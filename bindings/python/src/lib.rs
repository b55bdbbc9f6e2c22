//! The Python module `closeranks._native`: what the package `closeranks` is made of, at Rust's speed.
//!
//! Python owns the loop, the callbacks and the pictures (`python/closeranks`); here is what must be fast or exact. Calls that
//! take long let go of the interpreter, and return to it often enough that Ctrl-C works.

mod columns;
mod errors;
mod graph;
mod makers;
mod output;
mod paper;
mod robot;
mod rule;
mod run;
mod scenario;
mod sweep;
mod values;
mod world;

use pyo3::prelude::*;

/// Native part of the package closeranks. Use `import closeranks` instead.
#[pymodule(name = "_native")]
fn native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("VERSION", env!("CARGO_PKG_VERSION"))?;
    module.add("COMMIT", closeranks_sweep::PROGRAM.commit)?;
    module.add("MESSAGE_BYTES", closeranks_core::MESSAGE_BYTES)?;
    module.add("NODE_LIMIT", closeranks_graph::graph::set::NODE_LIMIT)?;
    errors::add(module)?;
    module.add_class::<scenario::Scenario>()?;
    module.add_class::<world::World>()?;
    module.add_class::<world::batch::Batch>()?;
    module.add_class::<run::Run>()?;
    module.add_class::<sweep::Sweep>()?;
    module.add_class::<sweep::SweepFolder>()?;
    module.add_class::<robot::Robot>()?;
    module.add_class::<output::Output>()?;
    module.add_function(wrap_pyfunction!(scenario::named, module)?)?;
    module.add_function(wrap_pyfunction!(scenario::controllers, module)?)?;
    module.add_function(wrap_pyfunction!(rule::rules, module)?)?;
    module.add_function(wrap_pyfunction!(rule::rule_update, module)?)?;
    module.add_function(wrap_pyfunction!(rule::rule_step, module)?)?;
    module.add_function(wrap_pyfunction!(graph::analyze, module)?)?;
    module.add_function(wrap_pyfunction!(graph::decide, module)?)?;
    module.add_function(wrap_pyfunction!(makers::make, module)?)?;
    Ok(())
}
