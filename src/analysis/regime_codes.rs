//! What the files say of the codes of regimes, once for all of them.

/// The codes of the regimes with their names, as a literal.
macro_rules! regime_codes {
    () => {
        "code: 0 unresolved, 1 no impact, 2 periodic, 3 periodic with sticking, 4 quasi-periodic, 5 chaotic, \
         6 aperiodic with sticking, 7 failed, 8 inadmissible start"
    };
}

pub(crate) use regime_codes;

#[cfg(test)]
mod tests {
    use crate::analysis::Regime;

    #[test]
    fn the_files_name_every_regime_by_its_code() {
        let codes: Vec<String> =
            Regime::ALL.iter().map(|regime| format!("{} {}", regime.code(), regime.name())).collect();
        assert_eq!(regime_codes!(), format!("code: {}", codes.join(", ")));
    }
}
