//! What the Python package `vinesink` needs of the library: cases, their documents as JSON, arrays of numbers.
//! What users see of it is in `package/vinesink/`; its types are in `_vinesink.pyi` there.

mod branch;
mod case;
mod decide;
mod errors;
mod many;
mod modal;
mod report;
mod simulate;
mod work;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
fn _vinesink(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<case::Case>()?;
    module.add_class::<modal::ModalCase>()?;
    module.add_function(wrap_pyfunction!(modal::parse, module)?)?;
    module.add_function(wrap_pyfunction!(modal::read, module)?)?;
    module.add_function(wrap_pyfunction!(case::schema, module)?)?;
    module.add_function(wrap_pyfunction!(many::simulate_many, module)?)?;
    module.add_function(wrap_pyfunction!(modal::compare, module)?)?;
    module.add_function(wrap_pyfunction!(many::regimes, module)?)?;
    module.add_function(wrap_pyfunction!(work::fail, module)?)
}
