//! Enums whose names a key of a case file may hold; a schema of theirs is derived where they are declared.

/// Declares such an enum: the names, spelled once, are those of the parser, the schema and the function
/// that is given first; the comments are what the schema says about them.
#[doc(hidden)]
#[macro_export]
macro_rules! names {
    ($name:ident: $(#[$meta:meta])* $vis:vis enum $type:ident {
        $($(#[$attribute:meta])* $variant:ident = $text:literal,)+
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Deserialize)]
        $vis enum $type {
            $($(#[$attribute])* #[serde(rename = $text)] $variant,)+
        }

        impl $type {
            /// All of them, in the order of a report.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$variant),+];

            /// The name in a case file.
            #[must_use]
            pub const fn $name(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)+
                }
            }

            /// The one of that name.
            #[allow(dead_code, reason = "not every enum is looked up by name")]
            pub fn of_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|one| one.$name() == name)
            }
        }
    };
}
