//! Addresses: `%IX0.0`, `%QW2`, `%MD4`.

use std::fmt;

/// The area behind the `%`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Area {
    /// `I`: inputs.
    Input,
    /// `Q`: outputs.
    Output,
    /// `M`: memory.
    Memory,
}

/// The width of what lies there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Size {
    /// `X`: one bit, with its number in the byte.
    Bit(u8),
    /// `W`: 16 bits.
    Word,
    /// `D`: 32 bits.
    Double,
}

/// An address in its one canonical spelling.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Address {
    /// The area.
    pub area: Area,
    /// The width.
    pub size: Size,
    /// The number behind it.
    pub number: u16,
}

impl Address {
    /// Reads an address; the error is a phrase that says what is wrong with it.
    pub fn parse(text: &str) -> Result<Address, String> {
        let form = || {
            format!(
                "`{text}` is not an address: a bit is `%IX0.0`, `%QX0.0` or `%MX0.0`, a word `%IW0`, `%QW0`, `%MW0` or `%MD0`"
            )
        };
        let rest = text.strip_prefix('%').ok_or_else(form)?;
        let mut letters = rest.chars();
        let area = match letters.next() {
            Some('I') => Area::Input,
            Some('Q') => Area::Output,
            Some('M') => Area::Memory,
            _ => return Err(form()),
        };
        let rest = letters.as_str();
        let (size, digits) = match (rest.strip_prefix('W'), rest.strip_prefix('D')) {
            (Some(digits), _) => (Size::Word, digits),
            (_, Some(digits)) if area == Area::Memory => (Size::Double, digits),
            (_, Some(_)) => {
                return Err("inputs and outputs are bits or words; 32 bits lie at `%MD`".into());
            }
            _ => {
                let (byte, bit) = rest
                    .strip_prefix('X')
                    .unwrap_or(rest)
                    .split_once('.')
                    .ok_or_else(form)?;
                (
                    Size::Bit(bit_number(bit).ok_or_else(|| bit_fault(bit, form))?),
                    byte,
                )
            }
        };
        let number = decimal(digits).ok_or_else(form)?;
        let number = u16::try_from(number)
            .map_err(|_| format!("`{text}` lies too high: 65535 is the highest number"))?;
        Ok(Address { area, size, number })
    }
}

fn bit_fault(bit: &str, form: impl Fn() -> String) -> String {
    match decimal(bit) {
        Some(bit) => format!("there is no bit {bit}: a byte has the bits 0 to 7"),
        None => form(),
    }
}

fn bit_number(text: &str) -> Option<u8> {
    decimal(text)
        .and_then(|bit| u8::try_from(bit).ok())
        .filter(|bit| *bit <= 7)
}

/// A number of digits only; leading zeros would make a second spelling of one address.
fn decimal(text: &str) -> Option<u64> {
    let plain = !text.is_empty()
        && text.bytes().all(|byte| byte.is_ascii_digit())
        && (text.len() == 1 || !text.starts_with('0'));
    plain.then(|| text.parse().unwrap_or(u64::MAX))
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let area = match self.area {
            Area::Input => 'I',
            Area::Output => 'Q',
            Area::Memory => 'M',
        };
        let number = self.number;
        match self.size {
            Size::Bit(bit) => write!(f, "%{area}X{number}.{bit}"),
            Size::Word => write!(f, "%{area}W{number}"),
            Size::Double => write!(f, "%{area}D{number}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_spelling_is_the_same_address() {
        for (short, long) in [
            ("%I0.0", "%IX0.0"),
            ("%Q3.7", "%QX3.7"),
            ("%M1.2", "%MX1.2"),
        ] {
            assert_eq!(Address::parse(short), Address::parse(long));
            assert_eq!(Address::parse(short).unwrap().to_string(), long);
        }
    }

    #[test]
    fn what_is_no_address_is_refused() {
        for text in [
            "",
            "%",
            "%I",
            "%X0.0",
            "%IX0",
            "%IX0.8",
            "%IX0.01",
            "%IX00.1",
            "%IW",
            "%IW1.0",
            "%ID0",
            "%QD0",
            "%IX65536.0",
            "%IX0.-1",
            "%IB0",
            "IX0.0",
            "%IX99999999999999999999.0",
        ] {
            assert!(Address::parse(text).is_err(), "{text}");
        }
    }
}
