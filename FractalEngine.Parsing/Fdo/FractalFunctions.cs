using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>The functions and the constant that expressions of fractal files may use. Angles are degrees.</summary>
internal static class FractalFunctions
{
    private static readonly Dictionary<string, (int ArgumentCount, Func<double, double, double> Compute)> All = new()
    {
        ["pi"] = (0, static (_, _) => Math.PI),
        ["sin"] = (1, static (x, _) => Sine(x)),
        ["cos"] = (1, static (x, _) => Cosine(x)),
        ["tan"] = (1, static (x, _) => Tangent(x)),
        ["sqrt"] = (1, static (x, _) => Math.Sqrt(x)),
        ["abs"] = (1, static (x, _) => Math.Abs(x)),
        ["floor"] = (1, static (x, _) => Math.Floor(x)),
        ["min"] = (2, Math.Min),
        ["max"] = (2, Math.Max),
        ["mod"] = (2, Modulo),
    };

    /// <summary>The names of the functions, without that of the constant.</summary>
    public static IEnumerable<string> Names => All.Where(static one => one.Value.ArgumentCount > 0).Select(static one => one.Key);

    /// <summary>Finds a function, or a constant, which has no arguments.</summary>
    public static bool TryFind(string name, out int argumentCount, out Func<double, double, double> compute)
    {
        var isFound = All.TryGetValue(name, out var found);
        (argumentCount, compute) = found;
        return isFound;
    }

    /// <summary>The sine of an angle in degrees, exact wherever it is rational at whole degrees: 0, ±1/2 and ±1.</summary>
    private static double Sine(double degrees) => Math.Abs(Math.IEEERemainder(degrees, 180)) == 30
        ? Math.CopySign(0.5, SineCosine.FromDegrees(degrees).Sine) : SineCosine.FromDegrees(degrees).Sine;

    private static double Cosine(double degrees) => Math.Abs(Math.IEEERemainder(degrees, 180)) == 60
        ? Math.CopySign(0.5, SineCosine.FromDegrees(degrees).Cosine) : SineCosine.FromDegrees(degrees).Cosine;

    private static double Tangent(double degrees) => Math.IEEERemainder(degrees, 180) is 45 or -45
        ? Math.CopySign(1, Math.IEEERemainder(degrees, 180))
        : SineCosine.FromDegrees(degrees).Sine / SineCosine.FromDegrees(degrees).Cosine;

    /// <summary>The remainder with the sign of the divisor; that of the division towards zero is exact.</summary>
    private static double Modulo(double x, double y)
    {
        var remainder = x % y;
        return remainder != 0 && remainder < 0 != y < 0 ? remainder + y : remainder;
    }
}
