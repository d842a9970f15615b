//! Absorbers and dampers on a structure whose natural frequencies are not those that they were made for.

use super::dampers::DamperChoice;
use super::linear::largest_peak;
use super::{ModalAnswer, ModalError};
use crate::case::ModalCase;
use crate::criteria::{Judged, Worst};
use crate::executor::Executor;
use crate::linear::ModalDamper;

/// By how much all natural frequencies are off, either way.
const OFF: f64 = 0.1;

/// The largest displacement of any place under any load where all natural frequencies are off; loads and devices stay.
#[derive(Debug, Clone, PartialEq)]
pub struct OffStructure {
    /// Natural frequencies over those of the case, less 1.
    pub off: f64,
    /// Without absorbers, in m.
    pub bare: f64,
    /// With the absorbers.
    pub worst: Option<Worst>,
    /// Its criteria.
    pub criteria: Vec<Judged>,
    /// With each choice of dampers, in m.
    pub dampers: Vec<f64>,
}

/// The structure of a case a tenth lower and higher, searched with half of the starts in the usual windows.
///
/// # Errors
/// [`ModalError`] where a motion cannot be flown.
pub fn off_structures(
    case: &ModalCase,
    dampers: &[DamperChoice],
    on: &dyn Executor,
) -> Result<Vec<OffStructure>, ModalError> {
    [-OFF, OFF].into_iter().map(|off| OffStructure::of(case, off, dampers, on)).collect()
}

impl OffStructure {
    fn of(
        case: &ModalCase,
        off: f64,
        choices: &[DamperChoice],
        on: &dyn Executor,
    ) -> Result<Self, ModalError> {
        let [starts, starts_at_one] =
            [case.starts, case.starts_at_one].map(|starts| starts.div_ceil(2));
        let there = case.with_frequencies(1.0 + off);
        let case = &ModalCase { starts, starts_at_one, periods: 0, ..there };
        let answer = ModalAnswer::of(case, on)?;
        let linear = |dampers: &[ModalDamper]| {
            case.loads.iter().map(|load| largest_peak(case, load, dampers)).fold(0.0, f64::max)
        };
        let with = |choice: &DamperChoice| {
            // Their frequencies are over the first mode's.
            let own = |one: &ModalDamper| ModalDamper {
                frequency: one.frequency / (1.0 + off),
                ..one.clone()
            };
            linear(&choice.dampers.iter().map(own).collect::<Vec<_>>())
        };
        Ok(Self {
            off,
            bare: linear(&[]),
            worst: answer.worst(case, None),
            criteria: answer.judged,
            dampers: choices.iter().map(with).collect(),
        })
    }
}
