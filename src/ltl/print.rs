//! From the tree to text: what is printed parses back to the same tree, and no other tool should read it otherwise.

use super::ast::{BinaryOperator, Formula, UnaryOperator};
use super::lexer::is_plain_name;
use super::parse::{from_the_right, precedence};
use std::fmt;

/// Which signs operators are printed with.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Style {
    /// `! & | ^ -> <-> X F G U R W M`.
    #[default]
    Ascii,
    /// `¬ ∧ ∨ ⊕ → ↔ ○ ◇ □ U R W M`.
    Unicode,
}

/// Where parentheses are printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Parentheses {
    /// Where they change the meaning, and around constructs on which tools disagree.
    #[default]
    Needed,
    /// Around every operator with its operands, but for `!` in front of a proposition and the outermost.
    Everywhere,
}

/// A formula to be printed in a certain way; see [`Formula::printed`].
#[derive(Clone, Copy, Debug)]
pub struct Printed<'a> {
    formula: &'a Formula,
    style: Style,
    parentheses: Parentheses,
}

impl Formula {
    /// The formula in a chosen style. Whatever the style, the text parses back to the same tree.
    ///
    /// ```
    /// use ltl_rover::ltl::{Formula, Parentheses, Style};
    /// let formula = Formula::parse("GFa & b U c")?;
    /// assert_eq!(formula.to_string(), "G F a & (b U c)");
    /// assert_eq!(formula.printed(Style::Unicode, Parentheses::Needed).to_string(), "□◇a ∧ (b U c)");
    /// assert_eq!(formula.printed(Style::Ascii, Parentheses::Everywhere).to_string(), "(G (F a)) & (b U c)");
    /// # Ok::<(), ltl_rover::ltl::ParseError>(())
    /// ```
    pub fn printed(&self, style: Style, parentheses: Parentheses) -> Printed<'_> {
        Printed { formula: self, style, parentheses }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.printed(Style::Ascii, Parentheses::Needed).fmt(f)
    }
}

impl fmt::Display for Printed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(self.formula, f)
    }
}

impl Printed<'_> {
    fn write(&self, formula: &Formula, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match formula {
            Formula::True => f.write_str("true"),
            Formula::False => f.write_str("false"),
            Formula::Proposition(name) => write_name(name, f),
            Formula::Unary(operator, operand) => {
                f.write_str(self.unary(*operator))?;
                let everywhere = self.parentheses == Parentheses::Everywhere;
                let bracketed = match **operand {
                    Formula::Binary(..) => true,
                    Formula::Unary(..) => everywhere,
                    _ => false,
                };
                let letter = self.style == Style::Ascii && *operator != UnaryOperator::Not;
                if letter {
                    f.write_str(" ")?;
                }
                self.write_bracketed(operand, bracketed, f)
            }
            Formula::Binary(operator, left, right) => {
                self.write_bracketed(left, self.brackets(*operator, left, Side::Left), f)?;
                write!(f, " {} ", self.binary(*operator))?;
                self.write_bracketed(right, self.brackets(*operator, right, Side::Right), f)
            }
        }
    }

    fn write_bracketed(&self, formula: &Formula, bracketed: bool, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if bracketed {
            f.write_str("(")?;
            self.write(formula, f)?;
            f.write_str(")")
        } else {
            self.write(formula, f)
        }
    }

    /// Whether `operand` needs parentheses on that side of `operator`.
    fn brackets(&self, operator: BinaryOperator, operand: &Formula, side: Side) -> bool {
        use BinaryOperator::{And, Or, Xor};
        let inner = match operand {
            Formula::Binary(inner, ..) => *inner,
            Formula::Unary(UnaryOperator::Not, negated) if matches!(**negated, Formula::Proposition(_)) => return false,
            Formula::Unary(..) => return self.parentheses == Parentheses::Everywhere,
            _ => return false,
        };
        if self.parentheses == Parentheses::Everywhere {
            return true;
        }
        let natural_side = if from_the_right(operator) { Side::Right } else { Side::Left };
        let changes_meaning = match precedence(inner).cmp(&precedence(operator)) {
            std::cmp::Ordering::Less => true,
            std::cmp::Ordering::Equal => side != natural_side,
            std::cmp::Ordering::Greater => false,
        };
        // The constructs that `parse` remarks on.
        let disputed = inner.is_temporal() && (operator.is_temporal() || matches!(operator, And | Or | Xor))
            || precedence(inner) == 0
            || (inner, operator) == (Xor, Or)
            || (inner, operator) == (And, Xor);
        changes_meaning || disputed
    }

    fn unary(&self, operator: UnaryOperator) -> &'static str {
        match (self.style, operator) {
            (Style::Ascii, UnaryOperator::Not) => "!",
            (Style::Ascii, UnaryOperator::Next) => "X",
            (Style::Ascii, UnaryOperator::Finally) => "F",
            (Style::Ascii, UnaryOperator::Globally) => "G",
            (Style::Unicode, UnaryOperator::Not) => "¬",
            (Style::Unicode, UnaryOperator::Next) => "○",
            (Style::Unicode, UnaryOperator::Finally) => "◇",
            (Style::Unicode, UnaryOperator::Globally) => "□",
        }
    }

    fn binary(&self, operator: BinaryOperator) -> &'static str {
        match (self.style, operator) {
            (Style::Unicode, BinaryOperator::And) => "∧",
            (Style::Unicode, BinaryOperator::Or) => "∨",
            (Style::Unicode, BinaryOperator::Xor) => "⊕",
            (Style::Unicode, BinaryOperator::Implies) => "→",
            (Style::Unicode, BinaryOperator::Iff) => "↔",
            (_, operator) => spelling(operator),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// The ASCII sign of `operator`.
pub(super) fn spelling(operator: BinaryOperator) -> &'static str {
    match operator {
        BinaryOperator::And => "&",
        BinaryOperator::Or => "|",
        BinaryOperator::Xor => "^",
        BinaryOperator::Implies => "->",
        BinaryOperator::Iff => "<->",
        BinaryOperator::Until => "U",
        BinaryOperator::Release => "R",
        BinaryOperator::WeakUntil => "W",
        BinaryOperator::StrongRelease => "M",
    }
}

/// Writes a proposition's name, in quotes unless it is a plain word.
fn write_name(name: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    if is_plain_name(name) { f.write_str(name) } else { write!(f, "\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\"")) }
}
