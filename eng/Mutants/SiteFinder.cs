using Microsoft.CodeAnalysis;
using Microsoft.CodeAnalysis.CSharp;
using Microsoft.CodeAnalysis.CSharp.Syntax;
using Microsoft.CodeAnalysis.Text;

namespace FractalEngine.Mutants;

/// <summary>Finds all sites of a file.</summary>
/// <remarks>
/// Left out is only what must be constant, and what is no code: attributes, constants, defaults of parameters, patterns, labels, names.
/// Whether a change compiles is the compiler's to say, later and only of what was drawn.
/// </remarks>
internal sealed class SiteFinder : CSharpSyntaxWalker
{
    private readonly string _path;
    private readonly SourceText _text;
    private readonly List<Site> _sites = [];
    private readonly Dictionary<string, int> _occurrences = [];

    private SiteFinder(string path, SourceText text)
    {
        _path = path;
        _text = text;
    }

    /// <summary>Returns the sites of a file in the order of their positions.</summary>
    /// <param name="path">Path relative to the checkout, with slashes.</param>
    /// <param name="source">Text of the file.</param>
    public static List<Site> Find(string path, string source)
    {
        var tree = CSharpSyntaxTree.ParseText(source, Parsing.Options);
        var finder = new SiteFinder(path, tree.GetText());
        finder.Visit(tree.GetRoot());
        finder._sites.Sort((a, b) => (a.Span.Start, -a.Span.Length).CompareTo((b.Span.Start, -b.Span.Length)));
        foreach (var site in finder._sites)
        {
            string key = $"{site.Member}|{site.OneLine}";
            site.Occurrence = finder._occurrences.GetValueOrDefault(key);
            finder._occurrences[key] = site.Occurrence + 1;
        }

        return finder._sites;
    }

    /// <summary>Returns the place of a fragment, whose member is to stand twice; null unless it occurs once and in a body.</summary>
    /// <param name="path">Path relative to the checkout, with slashes.</param>
    /// <param name="source">Text of the file.</param>
    /// <param name="fragment">Text within a member's body.</param>
    public static Site? At(string path, string source, string fragment)
    {
        int start = source.IndexOf(fragment, StringComparison.Ordinal);
        if (fragment.Length == 0 || start < 0 || source.IndexOf(fragment, start + 1, StringComparison.Ordinal) >= 0)
        {
            return null;
        }

        var (member, body) = Surroundings(CSharpSyntaxTree.ParseText(source, Parsing.Options).GetRoot().FindToken(start).Parent!);
        // The semicolon after an arrow's expression belongs to the member.
        var span = TextSpan.FromBounds(start, Math.Min(start + fragment.Length, body?.Expression?.End ?? int.MaxValue));
        return body is not null && (body.Expression ?? body.Span).Contains(span)
            ? new Site { Path = path, Member = member, Span = span, Original = source[span.Start..span.End], Form = Form.Body, Body = body }
            : null;
    }

    public override void Visit(SyntaxNode? node)
    {
        if (node is null || IsConstant(node))
        {
            return;
        }

        if (node is ExpressionSyntax or StatementSyntax or CollectionElementSyntax)
        {
            AddSite(node);
        }

        base.Visit(node);
    }

    private static bool IsConstant(SyntaxNode node) => node switch
    {
        AttributeListSyntax or PatternSyntax or TypeSyntax and not IdentifierNameSyntax or EnumMemberDeclarationSyntax => true,
        SwitchLabelSyntax and not CasePatternSwitchLabelSyntax => true,
        InterpolationAlignmentClauseSyntax or InterpolationFormatClauseSyntax => true,
        FieldDeclarationSyntax field => field.Modifiers.Any(SyntaxKind.ConstKeyword),
        LocalDeclarationStatementSyntax local => local.IsConst,
        EqualsValueClauseSyntax { Parent: ParameterSyntax } => true,
        InvocationExpressionSyntax { Expression: IdentifierNameSyntax { Identifier.Text: "nameof" } } => true,
        GotoStatementSyntax => true,
        _ => false,
    };

    private void AddSite(SyntaxNode node)
    {
        var changes = Operators.Of(node);
        if (changes.Count == 0)
        {
            return;
        }

        // The mutant of an expression that is a statement is a statement.
        var replaced = node;
        if (node.Parent is ExpressionStatementSyntax statement)
        {
            replaced = statement;
            changes = [.. changes.Select(change => new Change(change.Operator, change.Text + ";"))];
        }

        var (member, body) = Surroundings(replaced);
        bool isWholeBody = node.Parent is ArrowExpressionClauseSyntax && body is { IsVoid: true };
        if (isWholeBody)
        {
            changes.RemoveAll(change => change.Operator is "negated" or "default returned");
            changes.Add(new("statement removed", ""));
        }

        var existing = _sites.FindLast(site => site.Span == replaced.Span);
        if (existing is not null)
        {
            existing.Changes.AddRange(changes);
            return;
        }

        string original = _text.ToString(replaced.Span);
        var form = replaced is StatementSyntax ? Form.Statement
            : isWholeBody || body is not null && NeedsBody(node, original) ? Form.Body : Form.Expression;
        var site = new Site { Path = _path, Member = member, Span = replaced.Span, Original = original, Form = form, Body = body };
        site.Changes.AddRange(changes);
        _sites.Add(site);
    }

    // Parts of loops' heads, and calls after a question mark, can't stand in brackets.
    private static bool NeedsBody(SyntaxNode node, string original) =>
        node.Parent is ForStatementSyntax loop && loop.Condition != node
        || node is InvocationExpressionSyntax && original[0] is '.' or '[';

    private static (string Member, Body? Body) Surroundings(SyntaxNode node)
    {
        var names = new List<string>();
        Body? body = null;
        for (var above = node.Parent; above is not null; above = above.Parent)
        {
            body ??= BodyOf(above, node);
            string? name = above switch
            {
                BaseTypeDeclarationSyntax type => type.Identifier.Text,
                MethodDeclarationSyntax method => method.Identifier.Text + Types(method.ParameterList),
                ConstructorDeclarationSyntax constructor => ".ctor" + Types(constructor.ParameterList),
                OperatorDeclarationSyntax @operator => @operator.OperatorToken.Text + Types(@operator.ParameterList),
                ConversionOperatorDeclarationSyntax conversion => conversion.Type + Types(conversion.ParameterList),
                PropertyDeclarationSyntax property => property.Identifier.Text,
                IndexerDeclarationSyntax indexer => "this" + Types(indexer.ParameterList),
                EventDeclarationSyntax @event => @event.Identifier.Text,
                AccessorDeclarationSyntax accessor => accessor.Keyword.Text,
                VariableDeclaratorSyntax { Parent.Parent: BaseFieldDeclarationSyntax } field => field.Identifier.Text,
                _ => null,
            };
            if (name is not null)
            {
                names.Insert(0, name);
            }
        }

        return (string.Join('.', names), body);
    }

    private static string Types(BaseParameterListSyntax parameters) =>
        $"({string.Join(", ", parameters.Parameters.Select(parameter => parameter.Type?.ToString()))})";

    private static Body? BodyOf(SyntaxNode above, SyntaxNode node)
    {
        var (block, arrow, isVoid) = above switch
        {
            MethodDeclarationSyntax method => (method.Body, method.ExpressionBody, ReturnsNothing(method.ReturnType, method.Modifiers)),
            LocalFunctionStatementSyntax local => (local.Body, local.ExpressionBody, ReturnsNothing(local.ReturnType, local.Modifiers)),
            BaseMethodDeclarationSyntax other => (other.Body, other.ExpressionBody, other is ConstructorDeclarationSyntax),
            AccessorDeclarationSyntax accessor =>
                (accessor.Body, accessor.ExpressionBody, !accessor.IsKind(SyntaxKind.GetAccessorDeclaration)),
            PropertyDeclarationSyntax property => (null, property.ExpressionBody, false),
            IndexerDeclarationSyntax indexer => (null, indexer.ExpressionBody, false),
            _ => default,
        };
        if (block is not null && block.Span.Contains(node.Span))
        {
            return new(block.Span, null, isVoid, false);
        }

        // The semicolon goes with the arrow.
        return arrow is not null && arrow.Span.Contains(node.Span)
            ? new(TextSpan.FromBounds(arrow.SpanStart, arrow.GetLastToken().GetNextToken().Span.End), arrow.Expression.Span, isVoid,
                above is BasePropertyDeclarationSyntax)
            : null;
    }

    private static bool ReturnsNothing(TypeSyntax type, SyntaxTokenList modifiers) =>
        type is PredefinedTypeSyntax { Keyword.RawKind: (int)SyntaxKind.VoidKeyword }
        || modifiers.Any(SyntaxKind.AsyncKeyword) && type is IdentifierNameSyntax;
}
