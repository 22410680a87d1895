//! Expressions: precedence climbing over `language.md`, expressions.
//!
//! `OR`, `XOR`, `AND` bind loosest, then the prefixes `NOT ↑ ↓`, then timers, then comparisons and numbers.

use crate::ast::{Binary, Expression, ExpressionKind, Unary};
use crate::diagnostic::{Diagnostic, Rule};
use crate::lexer::token::{Keyword, TokenKind};
use crate::source::Span;

use super::MAX_EXPRESSION_DEPTH;
use super::cursor::{Parsed, Parser};

/// How tightly operators bind.
const AND: u8 = 3;
const XOR: u8 = 2;
const OR: u8 = 1;
const COMPARISON: u8 = 4;
const SUM: u8 = 5;
pub(super) const PRODUCT: u8 = 6;

/// An expression on its way up; boxed, so that deep nesting costs little stack.
pub(super) struct Tree {
    pub(super) expression: Box<Expression>,
    /// How many levels it has.
    depth: u32,
    /// Its place, parentheses included.
    pub(super) outer: Span,
    /// It stands in parentheses.
    pub(super) parenthesised: bool,
}

impl Tree {
    /// The tree of a kind over subtrees, the deepest of which has `depth` levels.
    pub(super) fn over(kind: ExpressionKind, span: Span, depth: u32) -> Tree {
        Tree {
            expression: Box::new(Expression { kind, span }),
            depth: depth + 1,
            outer: span,
            parenthesised: false,
        }
    }

    fn leaf(kind: ExpressionKind, span: Span) -> Tree {
        Tree::over(kind, span, 0)
    }

    /// How many levels it has.
    pub(super) fn depth(&self) -> u32 {
        self.depth
    }

    /// The deepest of several.
    pub(super) fn deepest<'t>(trees: impl IntoIterator<Item = &'t Tree>) -> u32 {
        trees.into_iter().map(|tree| tree.depth).max().unwrap_or(0)
    }
}

/// The operator that a token spells, and how tightly it binds.
fn operator_of(kind: TokenKind) -> Option<(Binary, u8)> {
    Some(match kind {
        TokenKind::Or => (Binary::Or, OR),
        TokenKind::Xor => (Binary::Xor, XOR),
        TokenKind::And => (Binary::And, AND),
        TokenKind::Equal => (Binary::Equal, COMPARISON),
        TokenKind::NotEqual => (Binary::NotEqual, COMPARISON),
        TokenKind::Less => (Binary::Less, COMPARISON),
        TokenKind::LessOrEqual => (Binary::LessOrEqual, COMPARISON),
        TokenKind::Greater => (Binary::Greater, COMPARISON),
        TokenKind::GreaterOrEqual | TokenKind::FatArrow => (Binary::GreaterOrEqual, COMPARISON),
        TokenKind::Plus => (Binary::Add, SUM),
        TokenKind::Minus => (Binary::Subtract, SUM),
        TokenKind::Star => (Binary::Multiply, PRODUCT),
        TokenKind::Slash => (Binary::Divide, PRODUCT),
        TokenKind::Mod => (Binary::Modulo, PRODUCT),
        _ => return None,
    })
}

/// The prefix that a token spells.
fn prefix_of(kind: TokenKind) -> Option<Unary> {
    match kind {
        TokenKind::Not => Some(Unary::Not),
        TokenKind::Rising => Some(Unary::Rising),
        TokenKind::Falling => Some(Unary::Falling),
        _ => None,
    }
}

impl Parser<'_> {
    /// A whole expression.
    pub(super) fn expression(&mut self) -> Parsed<Expression> {
        Ok(*self.tree()?.expression)
    }

    /// A whole expression with its measures.
    pub(super) fn tree(&mut self) -> Parsed<Tree> {
        self.binary(OR)
    }

    /// Operands joined by operators that bind at least as tightly as `minimum`.
    pub(super) fn binary(&mut self, minimum: u8) -> Parsed<Tree> {
        let mut left = self.operand()?;
        while let Some((operator, tightness)) = self.operator() {
            if tightness < minimum {
                break;
            }
            left = match operator {
                Binary::And | Binary::Or | Binary::Xor => self.chain(left, operator, tightness)?,
                Binary::Divide => self.quotient(left)?,
                _ => {
                    let operator_span = self.take_operator();
                    let right = self.binary(tightness + 1)?;
                    self.join(operator, operator_span, left, right)?
                }
            };
        }
        Ok(left)
    }

    /// The operator that comes next, if the expression goes on.
    fn operator(&self) -> Option<(Binary, u8)> {
        let kind = self.peek();
        if kind == TokenKind::Slash && self.context.slash_ends {
            None
        } else {
            operator_of(kind)
        }
    }

    /// Takes an operator; an `=>` among them is refused.
    pub(super) fn take_operator(&mut self) -> Span {
        let span = self.span_of(self.next_token());
        if self.at(TokenKind::FatArrow) {
            self.error(span, "`=>` is not an operator", "write `>=`");
        }
        self.bump();
        span
    }

    /// One node over two.
    pub(super) fn join(
        &mut self,
        operator: Binary,
        operator_span: Span,
        left: Tree,
        right: Tree,
    ) -> Parsed<Tree> {
        let depth = Tree::deepest([&left, &right]);
        let span = left.outer.to(right.outer);
        let kind = ExpressionKind::Binary {
            operator,
            operator_span,
            left: left.expression,
            right: right.expression,
        };
        self.bounded(Tree::over(kind, span, depth))
    }

    /// Refuses a tree that is too deep for those who walk it.
    pub(super) fn bounded(&mut self, tree: Tree) -> Parsed<Tree> {
        if tree.depth <= MAX_EXPRESSION_DEPTH {
            return Ok(tree);
        }
        let message = format!("this expression has more than {MAX_EXPRESSION_DEPTH} levels");
        let diagnostic = Diagnostic::new(Rule::Syntax, tree.outer, message)
            .help("store a part in a variable, or gather the operands in several parentheses");
        Err(self.fail(diagnostic))
    }

    /// `a AND b AND c ..` as a balanced tree, so that its depth grows with the logarithm of its length. The operators
    /// are associative and evaluate both sides, so this changes nothing but the depth.
    fn chain(&mut self, mut first: Tree, operator: Binary, tightness: u8) -> Parsed<Tree> {
        let mut others = Vec::new();
        while self.operator() == Some((operator, tightness)) {
            let span = self.take_operator();
            others.push((span, self.binary(tightness + 1)?));
        }
        // Neighbours are joined in pairs until one tree is left.
        while !others.is_empty() {
            let mut pairs = Vec::with_capacity(others.len() / 2);
            let mut rest = others.into_iter();
            if let Some((span, right)) = rest.next() {
                first = self.join(operator, span, first, right)?;
            }
            while let Some((before, left)) = rest.next() {
                let pair = match rest.next() {
                    Some((span, right)) => self.join(operator, span, left, right)?,
                    None => left,
                };
                pairs.push((before, pair));
            }
            others = pairs;
        }
        Ok(first)
    }

    /// An operand with the prefixes in front of it.
    pub(super) fn operand(&mut self) -> Parsed<Tree> {
        let kind = self.peek();
        if let Some(operator) = prefix_of(kind) {
            return self.nested(|parser| {
                let start = parser.bump();
                let operand = parser.binary(COMPARISON)?;
                let span = parser.span_of(start).to(operand.outer);
                parser.unary(operator, operand, span)
            });
        }
        match kind {
            TokenKind::Minus => self.nested(Self::negation),
            TokenKind::LeftParenthesis => self.nested(Self::parenthesised),
            TokenKind::Number => {
                let span = self.span_of(self.next_token());
                Ok(Tree::leaf(self.number(|value| value), span))
            }
            TokenKind::Duration => {
                let span = self.span_of(self.next_token());
                Ok(Tree::leaf(self.stretch(|value| value), span))
            }
            TokenKind::True | TokenKind::False => {
                let token = self.bump();
                let kind = ExpressionKind::Bool(token.kind == TokenKind::True);
                Ok(Tree::leaf(kind, self.span_of(token)))
            }
            TokenKind::Name => self.named(),
            TokenKind::Keyword(_) if !self.at(TokenKind::Keyword(Keyword::Do)) => self.variable(),
            _ => Err(self.operand_missing()),
        }
    }

    fn unary(&mut self, operator: Unary, operand: Tree, span: Span) -> Parsed<Tree> {
        let depth = operand.depth;
        let kind = ExpressionKind::Unary {
            operator,
            operand: operand.expression,
        };
        self.bounded(Tree::over(kind, span, depth))
    }

    /// The number that comes next, with its sign.
    fn number(&mut self, signed: fn(i64) -> i64) -> ExpressionKind {
        self.integer()
            .map(signed)
            .map_or(ExpressionKind::Unreadable, ExpressionKind::Integer)
    }

    /// The duration that comes next, with its sign.
    fn stretch(&mut self, signed: fn(i64) -> i64) -> ExpressionKind {
        self.milliseconds()
            .map(signed)
            .map_or(ExpressionKind::Unreadable, ExpressionKind::Duration)
    }

    /// `- x`; directly before an integer or a duration the two are one literal.
    fn negation(&mut self) -> Parsed<Tree> {
        let start = self.bump();
        let literal = match self.peek() {
            TokenKind::Number => Some(self.number(i64::saturating_neg)),
            TokenKind::Duration => Some(self.stretch(i64::saturating_neg)),
            _ => None,
        };
        if let Some(literal) = literal {
            return Ok(Tree::leaf(literal, self.span_since(start)));
        }
        let operand = self.operand()?;
        let span = self.span_of(start).to(operand.outer);
        self.unary(Unary::Negate, operand, span)
    }

    fn parenthesised(&mut self) -> Parsed<Tree> {
        let open = self.bump();
        let mut tree = self.in_parentheses(|parser| {
            let tree = parser.tree()?;
            if parser.at(TokenKind::RightParenthesis) {
                parser.bump();
                return Ok(tree);
            }
            if parser.next_token().breaks {
                // More likely the parenthesis is missing than an operator at the end of the line.
                parser.context.brackets = 0;
            }
            let message = format!("expected `)`, found {}", parser.found());
            let mut diagnostic = Diagnostic::new(Rule::Syntax, parser.span_here(), message)
                .label(parser.span_of(open), "the parenthesis that is open");
            if parser.at_operand() {
                diagnostic = diagnostic.help("an operator such as `AND` is missing");
            }
            Err(parser.fail(diagnostic))
        })?;
        tree.outer = self.span_since(open);
        tree.parenthesised = true;
        Ok(tree)
    }

    /// What begins with a name: a timer, `S(Graph)`, or a variable.
    fn named(&mut self) -> Parsed<Tree> {
        let second = self.peek_second();
        match self.text_of(self.next_token()) {
            "T" if second == TokenKind::Slash && !self.context.slash_ends => {
                self.nested(Self::timer)
            }
            "S" if second == TokenKind::LeftParenthesis => self.situation_comparison(),
            _ => self.variable(),
        }
    }

    pub(super) fn variable(&mut self) -> Parsed<Tree> {
        let reference = self.reference("a condition")?;
        if self.at(TokenKind::LeftParenthesis) {
            let message = format!("`{}` cannot be called", reference.name.text);
            let diagnostic = Diagnostic::new(Rule::Syntax, reference.span, message).help(
                "a timer is written `T/a/2s`; a situation `S(Graph) = {1}`; elsewhere an operator is missing",
            );
            return Err(self.fail(diagnostic));
        }
        let span = reference.span;
        Ok(Tree::leaf(ExpressionKind::Ref(reference), span))
    }

    /// `S(Graph) = {1, 3}`, `S(Graph) <> {I}`.
    fn situation_comparison(&mut self) -> Parsed<Tree> {
        let start = self.bump();
        self.bump();
        let graph = self.in_parentheses(|parser| {
            let graph = parser.name("the name of a graph")?;
            parser.expect(
                TokenKind::RightParenthesis,
                "`)` behind the name of the graph",
            )?;
            Ok(graph)
        })?;
        let equal = match self.peek() {
            TokenKind::Equal => true,
            TokenKind::NotEqual => false,
            _ => {
                return Err(self.expected_help(
                    "`=` or `<>` behind `S(..)`",
                    "a situation is compared with a set: `S(Graph) = {1, 3}`",
                ));
            }
        };
        self.bump();
        let situation = self.situation()?;
        if let crate::ast::Situation::Current(span) = situation {
            self.error(
                span,
                "`{*}` stands only in a forcing order",
                "compare with steps or with `{I}`",
            );
        }
        let kind = ExpressionKind::Situation {
            graph,
            situation,
            equal,
        };
        Ok(Tree::leaf(kind, self.span_since(start)))
    }

    /// Something stands here that could be an operand.
    pub(super) fn at_operand(&self) -> bool {
        let kind = self.peek();
        prefix_of(kind).is_some()
            || matches!(
                kind,
                TokenKind::Name
                    | TokenKind::Number
                    | TokenKind::Duration
                    | TokenKind::True
                    | TokenKind::False
                    | TokenKind::LeftParenthesis
            )
    }

    fn operand_missing(&mut self) -> super::cursor::Failed {
        let help = match self.peek() {
            TokenKind::Text => {
                "a text stands alone as a trigger or statement, never inside an expression"
            }
            TokenKind::LeftBrace => "a set stands only behind `S(Graph) =` and `F/Graph:`",
            TokenKind::LineEnd => {
                "a line may break behind an operator, a comma or `->`, before one, and inside parentheses"
            }
            TokenKind::Equal => "`=1` stands alone behind `when`",
            _ => return self.expected("a name, a number or a condition"),
        };
        self.expected_help("a name, a number or a condition", help)
    }
}
