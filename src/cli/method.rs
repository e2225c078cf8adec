//! The options of the control methods, which `control` and `map` share: made of the table of methods.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, value_parser};
use impact_atlas::control::{
    GivenOptions, METHODS, Method, MethodOption, OptionKind, OptionValue, Scheme, Site,
};
use impact_atlas::model::Setting;
use impact_atlas::plane::Quantity;

use super::values::{Assignment, count};
use super::{CliError, Result, note, wrong};

/// Reads the name of a method.
pub fn method() -> impl TypedValueParser<Value = &'static Method> {
    let names = METHODS.iter().map(|method| PossibleValue::new(method.name).help(method.about));
    PossibleValuesParser::new(names).try_map(|name| Method::named(&name).ok_or("no such method"))
}

/// The settings that axes can vary, by name, method by method.
pub fn varied() -> String {
    let of = |method: &&Method| method.varied.iter().map(|q| q.name).collect::<Vec<_>>().join(", ");
    METHODS.iter().map(of).collect::<Vec<_>>().join("; ")
}

/// The settings of the methods that were given.
#[derive(Clone, Debug)]
pub struct MethodArgs {
    given: GivenOptions,
    options: Vec<MethodOption>,
}

impl Args for MethodArgs {
    fn augment_args(command: Command) -> Command {
        Method::options().into_iter().fold(command, |command, (heading, of, option)| {
            let help = format!("{of}{}", option.help);
            let long =
                if option.more.is_empty() { help.clone() } else { format!("{help}\n\n{}", option.more) };
            let arg = Arg::new(option.name).long(option.name).value_name(option.value_name);
            let arg = arg.help(help).long_help(long).help_heading(heading);
            let arg = option.instead_of.into_iter().fold(arg, Arg::conflicts_with);
            command.arg(match option.kind {
                OptionKind::Word => arg,
                OptionKind::Count => arg.value_parser(count),
                OptionKind::Number => arg.value_parser(value_parser!(f64)).allow_negative_numbers(true),
                OptionKind::Choice(words) => {
                    let known = words.iter().map(|[word, help]| PossibleValue::new(*word).help(*help));
                    arg.value_parser(PossibleValuesParser::new(known))
                }
                OptionKind::Numbers => arg
                    .value_parser(value_parser!(f64))
                    .value_delimiter(',')
                    .num_args(1)
                    .action(ArgAction::Append)
                    .allow_hyphen_values(true),
            })
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for MethodArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let value = |option: &MethodOption| match option.kind {
            OptionKind::Number => matches.get_one(option.name).copied().map(OptionValue::Number),
            OptionKind::Count => matches.get_one(option.name).copied().map(OptionValue::Count),
            OptionKind::Numbers => {
                matches.get_many(option.name).map(|all| OptionValue::Numbers(all.copied().collect()))
            }
            OptionKind::Word | OptionKind::Choice(_) => {
                matches.get_one(option.name).cloned().map(OptionValue::Word)
            }
        };
        let (options, given) = Method::options()
            .into_iter()
            .filter_map(|(_, _, option)| Some((option, (option.name, value(&option)?))))
            .unzip();
        Ok(MethodArgs { given: GivenOptions(given), options })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl MethodArgs {
    /// The checked scheme of a method with what was set of it, on a system; options of another method are refused.
    pub fn scheme(&self, method: &Method, set: &[Assignment], setting: &Setting) -> Result<Scheme> {
        let replaced: Vec<_> = set.iter().map(|set| (format!("--set {set} sets"), set.quantity)).collect();
        self.refuse_replaced(method, &replaced)?;
        let site = Site::new(setting, self.given.word("stop")).map_err(CliError::input)?;
        let mut scheme = Scheme::given(method, &self.given, &site).map_err(CliError::input)?;
        Assignment::refuse_twice(set)?;
        for one in set {
            let Quantity::Control(setting) = one.quantity else { continue };
            scheme = scheme
                .with(setting, one.value)
                .ok_or_else(|| wrong!("--set {one} has no effect on {}: drop it", method.name))?;
        }
        scheme.check().map_err(CliError::input)?;
        Ok(scheme)
    }

    /// Refuses options of a method that something else replaces, told in words.
    pub fn refuse_replaced(&self, method: &Method, by: &[(String, Quantity)]) -> Result<()> {
        for (words, quantity) in by {
            let Quantity::Control(setting) = quantity else { continue };
            if let Some(given) = self.options.iter().find(|option| method.replaces(*setting, option)) {
                return Err(wrong!("--{} has no effect, since {words} it: drop one of the two", given.name));
            }
        }
        Ok(())
    }

    /// Says which names stand for parameters of the system and not for settings of a method, which has these names, too.
    pub fn note_shadowed(method: &Method, named: impl IntoIterator<Item = Quantity>) {
        for quantity in named {
            let Quantity::Parameter(parameter) = quantity else { continue };
            if let Some(setting) = method.varied.iter().find(|setting| setting.name == parameter.name()) {
                note(&format!(
                    "{} is a parameter of the system here, and not the setting of {}: --{} sets that, and no axis varies it \
                     while the parameter has its name",
                    setting.name,
                    method.name,
                    setting.option()
                ));
            }
        }
    }

    /// The first option that was given.
    pub fn any(&self) -> Option<&'static str> {
        self.options.first().map(|option| option.name)
    }
}
