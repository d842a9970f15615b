//! What the Python package `vinesink` needs of the library: cases, their documents as JSON, arrays of numbers.
//! What users see of it is in `package/vinesink/`; its types are in `_vinesink.pyi` there.

mod analyze;
mod branch;
mod case;
mod decide;
mod errors;
mod many;
mod report;
mod simulate;
mod work;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
fn _vinesink(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<case::Case>()?;
    module.add_function(wrap_pyfunction!(case::parse, module)?)?;
    module.add_function(wrap_pyfunction!(case::read, module)?)?;
    module.add_function(wrap_pyfunction!(case::schema, module)?)?;
    module.add_function(wrap_pyfunction!(many::simulate_many, module)?)?;
    module.add_function(wrap_pyfunction!(case::compare, module)?)?;
    module.add_function(wrap_pyfunction!(many::regimes, module)?)?;
    module.add_function(wrap_pyfunction!(work::fail, module)?)
}
