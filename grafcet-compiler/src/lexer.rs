//! From text to tokens: `language.md`, lexical rules.
//!
//! The lexer finds where a literal ends; what it is worth is read by [`crate::literals`] where the parser takes it.

mod scan;
pub(crate) mod token;

use std::borrow::Cow;

use unicode_normalization::{IsNormalized, UnicodeNormalization, is_nfc_quick};

use crate::report::Report;
use crate::source::{FileId, Span};
use token::{Token, TokenKind};

/// How many bytes of UTF-8 a name, a number, a duration or an address may have. Messages repeat names, so a longer one
/// would make them long out of all proportion.
pub const MAX_WORD: usize = 4096;

/// What a text consists of, in source order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lexed {
    /// All tokens, the last of them [`TokenKind::EndOfFile`].
    pub(crate) tokens: Vec<Token>,
    /// All comments.
    pub(crate) comments: Vec<Span>,
}

/// All tokens and comments of a text. Linear in the size of the text.
pub(crate) fn lex(file: FileId, text: &str, report: &mut Report) -> Lexed {
    scan::Scanner::new(file, text, report).run()
}

/// A name as names are compared: in Unicode NFC.
pub(crate) fn normalized(name: &str) -> Cow<'_, str> {
    if is_nfc_quick(name.chars()) == IsNormalized::Yes {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(name.nfc().collect())
    }
}

/// A letter, with which a name begins (Unicode UAX #31).
pub(crate) fn begins_name(c: char) -> bool {
    unicode_ident::is_xid_start(c)
}

/// A letter, a digit or `_` (Unicode UAX #31, without the points that spell `AND`).
pub(crate) fn continues_name(c: char) -> bool {
    unicode_ident::is_xid_continue(c) && !matches!(c, '·' | '\u{387}')
}

/// The bytes `start..end` of a file; what lies beyond 4 GiB is reported at 4 GiB.
fn span(file: FileId, start: usize, end: usize) -> Span {
    let offset = |at| u32::try_from(at).unwrap_or(u32::MAX);
    Span {
        file,
        start: offset(start),
        end: offset(end),
    }
}

impl TokenKind {
    /// What a word is: a keyword, an operator or a name.
    fn of_word(word: &str) -> TokenKind {
        if let Some(keyword) = token::Keyword::of(word) {
            TokenKind::Keyword(keyword)
        } else {
            token::operator_word(word).unwrap_or(TokenKind::Name)
        }
    }
}
