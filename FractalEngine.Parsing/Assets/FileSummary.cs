using System.Globalization;
using System.Text.Encodings.Web;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// The facts about a loaded file: kind, counts, bounds, size and times. Counts are of the scene with all fractals expanded, without what
/// they make twice, and where that is not known of an upper bound. A model counts once per object that shows it.
/// </summary>
/// <param name="file">The loaded file.</param>
/// <param name="loadTime">Time of parsing and checking all files, and of finding the bounds.</param>
/// <param name="prepareTime">Further time until the scene could be drawn; null where it was not prepared.</param>
public sealed class FileSummary(LoadedFile file, TimeSpan loadTime, TimeSpan? prepareTime)
{
    /// <summary>Formats the summary as one JSON object, in which numbers of any length are written out.</summary>
    public string ToJson() => "{" + string.Join(", ", Fields(FormatJson).Select(field => $"\"{field.Name}\": {field.Value}")) + "}";

    /// <summary>Formats the summary as text with one field per line.</summary>
    public string ToText() => string.Join('\n', Fields(FormatPlain).Select(field => $"{field.Name,-20}{field.Value}"));

    private IEnumerable<(string Name, string Value)> Fields(Func<object?, string> format)
    {
        var scene = file.Scene;
        var bounds = scene.Bounds;
        var surface = SurfaceSummary.Of(scene);
        var chains = scene.Sum(static model => model.InstanceCount);
        var ranges = scene.Models.OfType<FractalModel>().Where(static model => model.Fractal.Description.HasChance).Distinct()
            .ToDictionary(static model => (Model)model, static model => model.Fractal.CountRange());
        var instances = scene.Models.SelectMany(static model => model.Parts).ToDictionary(part => part, CountInstances);
        return
        [
            ("kind", format(file.Kind.ToString().ToLowerInvariant())),
            ("handed", format(scene.Scene.Handedness.ToString().ToLowerInvariant())),
            ("meshes", format(scene.Objects is [{ Model: FractalModel model }] ? MeshNames(model) : null)),
            ("vertices", FormatCount(Sum(static mesh => mesh.VertexCount), format)),
            ("faces", FormatCount(Sum(static mesh => mesh.FaceCount), format)),
            ("instances", FormatCount(SumRanges(static range => range?.Exact), format)),
            ("chains", FormatCount(ranges.Count == 0 ? chains : SumRanges(static range => range?.Exact), format)),
            .. ranges.Count == 0 ? [] : new (string Name, string Value)[]
            {
                ("leastInstances", FormatCount(SumRanges(static range => range?.Least), format)),
                ("expectedInstances", FormatCount(SumRanges(static range => range?.Expected), format)),
                ("mostInstances", FormatCount(SumRanges(static range => range?.Most), format)),
            },
            ("infinite", format(scene.Models.Any(static model => model is FractalModel { Fractal.Description.IsInfinite: true }))),
            ("boundsMin", format(bounds.IsEmpty ? null : bounds.Minimum)),
            ("boundsMax", format(bounds.IsEmpty ? null : bounds.Maximum)),
            ("area", format(surface.Area)),
            ("volume", format(surface.Volume)),
            ("closed", format(surface.Open is null)),
            ("openMesh", format(surface.Open?.Mesh)),
            ("openEdge", format(surface.Open?.Edge)),
            ("storageBytes", format(file.StorageBytes)),
            ("loadMilliseconds", FormatTime(loadTime, format)),
            ("prepareMilliseconds", FormatTime(prepareTime, format)),
        ];

        BigInteger? SumRanges(Func<InstanceRange?, BigInteger?> valueOf) => scene.Sum(model =>
            ranges.TryGetValue(model, out var range) ? valueOf(range) : SumOf(model, static _ => 1));

        BigInteger? Sum(Func<Mesh, long> valueOf) => scene.Sum(model => SumOf(model, valueOf));

        BigInteger? SumOf(Model model, Func<Mesh, long> valueOf) => model.Parts.Aggregate(
            (BigInteger?)BigInteger.Zero, (sum, part) => sum + (instances[part] * valueOf(part.Mesh)));
    }

    private static string MeshNames(FractalModel model) =>
        string.Join(", ", Enumerable.Range(0, model.Fractal.BaseMeshes.Length).Select(model.MeshNameAt));

    private static string FormatTime(TimeSpan? time, Func<object?, string> format) =>
        format(time is { } known ? Math.Round(known.TotalMilliseconds, 3) : null);

    private static string FormatCount(BigInteger? count, Func<object?, string> format) =>
        count is { } number ? DecimalText.Format(number) : format(null);

    private static string FormatJson(object? value) => value switch
    {
        null => "null",
        bool flag => flag ? "true" : "false",
        string text => $"\"{JavaScriptEncoder.UnsafeRelaxedJsonEscaping.Encode(text)}\"",
        // JSON has no infinity.
        Vector vector when !vector.IsFinite() => "null",
        double number when !double.IsFinite(number) => "null",
        Vector(var x, var y, var z) => FormattableString.Invariant($"[{x:R}, {y:R}, {z:R}]"),
        IFormattable number => number.ToString(null, CultureInfo.InvariantCulture),
        _ => throw new ArgumentOutOfRangeException(nameof(value)),
    };

    private static string FormatPlain(object? value) => value switch
    {
        null => "-",
        bool flag => flag ? "yes" : "no",
        Vector(var x, var y, var z) => string.Create(CultureInfo.InvariantCulture, $"{x:R} {y:R} {z:R}"),
        _ => string.Create(CultureInfo.InvariantCulture, $"{value}"),
    };

    private static BigInteger? CountInstances(Model model) => model switch
    {
        FractalModel { Fractal: var fractal } =>
            DistinctInstances.Count(fractal) ?? DistinctInstances.CountAtMost(fractal, budget: 0),
        _ => BigInteger.One,
    };
}
