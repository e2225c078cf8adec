//! What an axis varies: a parameter, a component of the start, or a setting of a control method.

use serde::Serialize;

use super::axis_error::AxisError;
use super::component::Component;
use crate::control::ControlQuantity;
use crate::model::Parameter;
use crate::system::Family;

/// What an axis varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// A parameter of the system.
    Parameter(Parameter),
    /// A component of the start.
    Start(Component),
    /// A setting of a control method.
    Control(ControlQuantity),
}

impl Quantity {
    /// Whether systems of a family have it.
    pub fn is_of(self, family: &Family) -> bool {
        match self {
            Quantity::Parameter(parameter) => std::ptr::eq(parameter.family(), family),
            Quantity::Start(component) => component.coordinates() == family.n(),
            Quantity::Control(_) => true,
        }
    }

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Parameter(parameter) => parameter.name(),
            Quantity::Start(component) => component.name(),
            Quantity::Control(setting) => setting.name,
        }
    }

    /// The quantity of a name: a component of the start, a parameter of the family, a setting of a control method, in this
    /// order.
    ///
    /// # Errors
    /// [`AxisError::UnknownName`] with the names that there are.
    pub fn named(name: &str, family: &'static Family) -> Result<Self, AxisError> {
        if let Some(component) = Component::named(name, family.n()) {
            return Ok(Quantity::Start(component));
        }
        if let Ok(parameter) = Parameter::of(family, name) {
            return Ok(Quantity::Parameter(parameter));
        }
        let setting = ControlQuantity::all().find(|setting| setting.name == name);
        setting.map(Quantity::Control).ok_or_else(|| {
            let parameters = Parameter::all(family).map(Parameter::name);
            let known = Vec::from_iter(parameters.chain(Component::all(family.n()).map(Component::name)));
            let settings =
                Vec::from_iter(ControlQuantity::of_coordinates(family.n()).map(|setting| setting.name));
            let [known, settings] = [known, settings].map(|names| names.join(", "));
            AxisError::UnknownName { name: name.to_owned(), known, settings }
        })
    }
}

impl Serialize for Quantity {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
