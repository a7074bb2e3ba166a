using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>The functions and the constant that expressions of fractal files may use. Angles are degrees.</summary>
internal static class FractalFunctions
{
    private static readonly Dictionary<string, (int ArgumentCount, Func<double, double, double> Compute)> All = new()
    {
        ["pi"] = (0, static (_, _) => Math.PI),
        ["sin"] = (1, static (x, _) => SineCosine.FromDegrees(x).Sine),
        ["cos"] = (1, static (x, _) => SineCosine.FromDegrees(x).Cosine),
        ["tan"] = (1, static (x, _) => SineCosine.FromDegrees(x).Sine / SineCosine.FromDegrees(x).Cosine),
        ["sqrt"] = (1, static (x, _) => Math.Sqrt(x)),
        ["abs"] = (1, static (x, _) => Math.Abs(x)),
        ["floor"] = (1, static (x, _) => Math.Floor(x)),
        ["min"] = (2, Math.Min),
        ["max"] = (2, Math.Max),
        ["mod"] = (2, static (x, y) => x - (y * Math.Floor(x / y))),
    };

    /// <summary>The names, in the order of a listing.</summary>
    public static IEnumerable<string> Names => All.Keys;

    /// <summary>Finds a function, or a constant, which has no arguments.</summary>
    public static bool TryFind(string name, out int argumentCount, out Func<double, double, double> compute)
    {
        var isFound = All.TryGetValue(name, out var found);
        (argumentCount, compute) = found;
        return isFound;
    }
}
