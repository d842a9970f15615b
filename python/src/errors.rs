//! Exceptions of the package, which `package/vinesink/_errors.py` defines.

use pyo3::import_exception;

import_exception!(vinesink._errors, CaseError);
import_exception!(vinesink._errors, FileError);
import_exception!(vinesink._errors, InternalError);
import_exception!(vinesink._errors, RefusedError);
