using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Computes a number that stands alone, written as in fractal files: <c>1/3</c>.</summary>
public sealed class NumberExpression : ExpressionParser
{
    private NumberExpression(string text)
        : base(new("number", text), null)
    {
    }

    /// <summary>Computes an expression of numbers, functions and <c>pi</c>.</summary>
    /// <exception cref="SourceException">The text is no expression, or has no finite value.</exception>
    public static double Compute(string text)
    {
        ArgumentNullException.ThrowIfNull(text);
        var parser = new NumberExpression(text);
        return parser.ParseBlanks(parser.Source.Start, out var start) && parser.ParseExpression(start, out var value, out var rest)
            && parser.ParseEndOfLine(rest, out _) ? value : throw parser.SyntaxError();
    }
}
