using System.Globalization;
using Microsoft.CodeAnalysis;
using Microsoft.CodeAnalysis.CSharp;
using Microsoft.CodeAnalysis.CSharp.Syntax;

namespace FractalEngine.Mutants;

/// <summary>The mutation operators: the ordinary ones of the literature and of Stryker.</summary>
internal static class Operators
{
    // What stands in the place of each operator, one mutant each.
    private static readonly Dictionary<string, string[]> Tokens = new()
    {
        ["+"] = ["-"],
        ["-"] = ["+"],
        ["*"] = ["/"],
        ["/"] = ["*"],
        ["%"] = ["*"],
        ["<<"] = [">>"],
        [">>"] = ["<<"],
        [">>>"] = ["<<"],
        ["&"] = ["|"],
        ["|"] = ["&"],
        ["^"] = ["&"],
        ["<"] = ["<=", ">="],
        ["<="] = ["<", ">"],
        [">"] = [">=", "<="],
        [">="] = [">", "<"],
        ["=="] = ["!="],
        ["!="] = ["=="],
        ["&&"] = ["||"],
        ["||"] = ["&&"],
        ["+="] = ["-="],
        ["-="] = ["+="],
        ["*="] = ["/="],
        ["/="] = ["*="],
        ["%="] = ["*="],
        ["<<="] = [">>="],
        [">>="] = ["<<="],
        ["&="] = ["|="],
        ["|="] = ["&="],
        ["^="] = ["&="],
        ["??="] = ["="],
        ["++"] = ["--"],
        ["--"] = ["++"],
    };

    private static readonly Dictionary<string, string> Methods = Pairs(
        "Min Max", "MinBy MaxBy", "MinMagnitude MaxMagnitude", "Floor Ceiling", "Sin Cos", "Asin Acos", "First Last",
        "FirstOrDefault LastOrDefault", "Any All", "OrderBy OrderByDescending", "ThenBy ThenByDescending", "Skip Take",
        "SkipWhile TakeWhile", "StartsWith EndsWith", "TrimStart TrimEnd", "IndexOf LastIndexOf", "ToUpperInvariant ToLowerInvariant",
        "BitIncrement BitDecrement", "Union Intersect", "LessThan GreaterThan", "LessThanOrEqual GreaterThanOrEqual", "Add Subtract",
        "Multiply Divide", "TrueForAll Exists", "Push Pop");

    // Functions that can be left out, so that their first argument, or what they are called on, stays.
    private static readonly HashSet<string> Transparent =
        ["Abs", "Sqrt", "Floor", "Ceiling", "Round", "Truncate", "Clamp", "Reverse", "Distinct", "Where", "Order", "Trim", "Normalized"];

    // Functions that say the same for swapped arguments.
    private static readonly HashSet<string> Symmetric =
    [
        "Min", "Max", "MinNative", "MaxNative", "MinNumber", "MaxNumber", "Dot", "Distance", "DistanceSquared", "Add", "Multiply", "Hypot",
        "Equals", "ReferenceEquals", "SequenceEqual", "EqualsAny", "EqualsAll", "BitwiseAnd", "BitwiseOr", "Xor",
    ];

    /// <summary>Returns all changes of a node; their texts replace the whole node.</summary>
    public static List<Change> Of(SyntaxNode node)
    {
        var changes = new List<Change>();
        switch (node)
        {
            case BinaryExpressionSyntax { RawKind: (int)SyntaxKind.CoalesceExpression } coalesce:
                changes.Add(new("?? left", coalesce.Left + "!"));
                changes.Add(new("?? right", coalesce.Right.ToString()));
                break;
            case BinaryExpressionSyntax binary when Tokens.TryGetValue(binary.OperatorToken.Text, out var others):
                changes.AddRange(others.Select(other => Swap(node, binary.OperatorToken, other)));
                break;
            case AssignmentExpressionSyntax assignment when Tokens.TryGetValue(assignment.OperatorToken.Text, out var others):
                changes.AddRange(others.Select(other => Swap(node, assignment.OperatorToken, other)));
                break;
            case PrefixUnaryExpressionSyntax prefix when Tokens.TryGetValue(prefix.OperatorToken.Text, out var others)
                    && prefix.Kind() is SyntaxKind.PreIncrementExpression or SyntaxKind.PreDecrementExpression:
                changes.AddRange(others.Select(other => Swap(node, prefix.OperatorToken, other)));
                break;
            case PrefixUnaryExpressionSyntax prefix when prefix.Kind() is SyntaxKind.UnaryMinusExpression or SyntaxKind.LogicalNotExpression
                    or SyntaxKind.BitwiseNotExpression:
                changes.Add(new($"{prefix.OperatorToken.Text} dropped", prefix.Operand.ToString()));
                break;
            case PostfixUnaryExpressionSyntax postfix when Tokens.TryGetValue(postfix.OperatorToken.Text, out var others):
                changes.AddRange(others.Select(other => Swap(node, postfix.OperatorToken, other)));
                break;
            case ConditionalExpressionSyntax choice:
                changes.Add(new("?: swapped", $"{choice.Condition} ? {choice.WhenFalse} : {choice.WhenTrue}"));
                break;
            case LiteralExpressionSyntax literal:
                AddLiteral(literal, changes);
                break;
            case InterpolatedStringExpressionSyntax:
                changes.Add(new("text emptied", "$\"\""));
                break;
            case InvocationExpressionSyntax call:
                AddCall(call, changes);
                break;
            case BaseObjectCreationExpressionSyntax { ArgumentList: { } arguments }:
                AddSwaps(node, arguments, changes);
                break;
            case CollectionExpressionSyntax { Elements.Count: > 0 }:
                changes.Add(new("collection emptied", "[]"));
                break;
            case StatementSyntax:
                AddStatement((StatementSyntax)node, changes);
                break;
        }

        if (node is ExpressionSyntax expression)
        {
            AddPlace(expression, changes);
        }

        return changes;
    }

    // What depends on where an expression stands: conditions are negated, results replaced.
    private static void AddPlace(ExpressionSyntax expression, List<Change> changes)
    {
        bool isCondition = expression.Parent switch
        {
            IfStatementSyntax statement => statement.Condition == expression,
            WhileStatementSyntax loop => loop.Condition == expression,
            DoStatementSyntax loop => loop.Condition == expression,
            ForStatementSyntax loop => loop.Condition == expression,
            ConditionalExpressionSyntax choice => choice.Condition == expression,
            WhenClauseSyntax => true,
            _ => false,
        };
        bool isResult = expression.Parent switch
        {
            ReturnStatementSyntax or ArrowExpressionClauseSyntax => true,
            LambdaExpressionSyntax lambda => lambda.ExpressionBody == expression,
            _ => false,
        };
        bool isLiteral = expression is LiteralExpressionSyntax or RefExpressionSyntax or ThrowExpressionSyntax;
        if ((isCondition || isResult) && !isLiteral && !expression.IsKind(SyntaxKind.LogicalNotExpression))
        {
            changes.Add(new("negated", $"!({expression})"));
        }

        if (isResult && !isLiteral)
        {
            changes.Add(new("default returned", "default"));
        }
    }

    private static void AddStatement(StatementSyntax statement, List<Change> changes)
    {
        bool isRemovable = statement switch
        {
            ExpressionStatementSyntax
            {
                Expression: InvocationExpressionSyntax or AssignmentExpressionSyntax or AwaitExpressionSyntax
                or PostfixUnaryExpressionSyntax or PrefixUnaryExpressionSyntax or ConditionalAccessExpressionSyntax
            } => true,
            BreakStatementSyntax or ContinueStatementSyntax or ThrowStatementSyntax or YieldStatementSyntax => true,
            ReturnStatementSyntax { Expression: null } => true,
            _ => false,
        };
        if (isRemovable)
        {
            changes.Add(new("statement removed", ";"));
        }
    }

    private static void AddLiteral(LiteralExpressionSyntax literal, List<Change> changes)
    {
        switch (literal.Kind())
        {
            case SyntaxKind.TrueLiteralExpression:
                changes.Add(new("true to false", "false"));
                break;
            case SyntaxKind.FalseLiteralExpression:
                changes.Add(new("false to true", "true"));
                break;
            case SyntaxKind.StringLiteralExpression:
                changes.Add(literal.Token.ValueText.Length > 0 ? new("text emptied", "\"\"") : new("text filled", "\"mutant\""));
                break;
            case SyntaxKind.Utf8StringLiteralExpression:
                changes.Add(literal.Token.ValueText.Length > 0 ? new("text emptied", "\"\"u8") : new("text filled", "\"mutant\"u8"));
                break;
            case SyntaxKind.CharacterLiteralExpression:
                changes.Add(new("character changed", literal.Token.ValueText == "x" ? "'y'" : "'x'"));
                break;
            case SyntaxKind.NumericLiteralExpression:
                AddNumber(literal, changes);
                break;
        }
    }

    private static void AddNumber(LiteralExpressionSyntax literal, List<Change> changes)
    {
        string text = literal.Token.Text;
        bool isReal = literal.Token.Value is double or float or decimal;
        string suffix = text[(text.TrimEnd(isReal ? ['d', 'D', 'f', 'F', 'm', 'M'] : ['u', 'U', 'l', 'L']).Length)..];
        switch (literal.Token.Value)
        {
            case double or float or decimal:
                double real = Convert.ToDouble(literal.Token.Value, CultureInfo.InvariantCulture);
                string kept = suffix.Length > 0 || !text.Contains('.', StringComparison.Ordinal) ? suffix : "d";
                changes.Add(real == 0 ? new("0 to 1", "1" + kept)
                    : real == 1 ? new("1 to 0", "0" + kept)
                    : new("number + 1", $"({text} + 1)"));
                if (real != 0)
                {
                    changes.Add(new("number doubled", $"(2 * {text})"));
                }

                break;
            case int or uint or long or ulong:
                ulong whole = Convert.ToUInt64(literal.Token.Value, CultureInfo.InvariantCulture);
                if (whole == 1)
                {
                    changes.Add(new("1 to 0", "0" + suffix));
                    changes.Add(new("number + 1", "2" + suffix));
                }
                else if (whole < ulong.MaxValue / 2)
                {
                    changes.Add(new(whole == 0 ? "0 to 1" : "number + 1", (whole + 1).ToString(CultureInfo.InvariantCulture) + suffix));
                    if (whole > 1)
                    {
                        changes.Add(new("number doubled", (whole * 2).ToString(CultureInfo.InvariantCulture) + suffix));
                    }
                }

                break;
        }
    }

    private static void AddCall(InvocationExpressionSyntax call, List<Change> changes)
    {
        var name = call.Expression switch
        {
            MemberAccessExpressionSyntax access => access.Name,
            MemberBindingExpressionSyntax binding => binding.Name,
            SimpleNameSyntax simple => simple,
            _ => null,
        };
        if (name is not null && Methods.TryGetValue(name.Identifier.Text, out string? other))
        {
            changes.Add(Swap(call, name.Identifier, other));
        }

        if (call.Expression is MemberAccessExpressionSyntax { Name: { } called } target && Transparent.Contains(called.Identifier.Text))
        {
            bool isStatic = target.Expression is PredefinedTypeSyntax or IdentifierNameSyntax { Identifier.Text: "Math" or "MathF" };
            string? rest = !isStatic ? target.Expression.ToString() : call.ArgumentList.Arguments.FirstOrDefault()?.Expression.ToString();
            if (rest is not null)
            {
                changes.Add(new($"{called.Identifier.Text} dropped", rest));
            }
        }

        if (name is null || !Symmetric.Contains(name.Identifier.Text))
        {
            AddSwaps(call, call.ArgumentList, changes);
        }
    }

    // Whether both have the same type is the compiler's to say: if not, the mutant mostly doesn't compile.
    private static void AddSwaps(SyntaxNode node, ArgumentListSyntax list, List<Change> changes)
    {
        for (int i = 0; i + 1 < list.Arguments.Count; i++)
        {
            var (first, second) = (list.Arguments[i], list.Arguments[i + 1]);
            bool isPlain = first.NameColon is null && second.NameColon is null
                && first.RefKindKeyword.RawKind == second.RefKindKeyword.RawKind;
            if (isPlain && first.ToString() != second.ToString())
            {
                var swapped = list.Arguments.Replace(first, second.WithTriviaFrom(first));
                swapped = swapped.Replace(swapped[i + 1], first.WithTriviaFrom(second));
                string text = node.ToString();
                int start = list.Arguments.Span.Start - node.SpanStart;
                changes.Add(new($"arguments {i + 1} and {i + 2} swapped",
                    string.Concat(text.AsSpan(0, start), swapped.ToString(), text.AsSpan(start + list.Arguments.Span.Length))));
            }
        }
    }

    private static Change Swap(SyntaxNode node, SyntaxToken token, string other)
    {
        string text = node.ToString();
        int start = token.SpanStart - node.SpanStart;
        return new($"{token.Text} to {other}", string.Concat(text.AsSpan(0, start), other, text.AsSpan(start + token.Text.Length)));
    }

    private static Dictionary<string, string> Pairs(params string[] pairs)
    {
        var both = new Dictionary<string, string>();
        foreach (var pair in pairs.Select(pair => pair.Split(' ')))
        {
            both[pair[0]] = pair[1];
            both[pair[1]] = pair[0];
        }

        return both;
    }
}
