using System.Globalization;
using System.Text.Encodings.Web;
using System.Text.Json;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.App.Jobs;

/// <summary>
/// The facts that <c>info</c> prints about a file. Counts are exact, of the scene with all fractals expanded.
/// </summary>
/// <param name="Kind">The kind of file: mesh, fractal or scene.</param>
/// <param name="Handedness">How the file's coordinates are shown.</param>
/// <param name="Vertices">Number of vertices; null where it is infinite.</param>
/// <param name="Faces">Number of faces; null where it is infinite.</param>
/// <param name="Instances">Number of base mesh instances; null where it is infinite.</param>
/// <param name="DistinctInstances">Number of instances without duplicates; null where it is unknown.</param>
/// <param name="Bounds">Bounding box of the scene in world space, scene units.</param>
/// <param name="StorageBytes">Size of the files in bytes.</param>
/// <param name="LoadTime">Time of parsing and checking all files, and of finding the bounds.</param>
/// <param name="PrepareTime">Further time until the scene could be drawn; null where it was not prepared.</param>
internal sealed record FileSummary(
    string Kind,
    Handedness Handedness,
    BigInteger? Vertices,
    BigInteger? Faces,
    BigInteger? Instances,
    BigInteger? DistinctInstances,
    BoundingBox Bounds,
    long StorageBytes,
    TimeSpan LoadTime,
    TimeSpan? PrepareTime)
{
    /// <summary>Counts the contents of a loaded file. A model counts once per object that shows it.</summary>
    public static FileSummary Of(LoadedFile file, TimeSpan loadTime, TimeSpan? prepareTime)
    {
        var distinctCounts = file.Scene.Models.ToDictionary(model => model, CountDistinctInstances);
        return new(
            file.Kind.ToString().ToLowerInvariant(),
            file.Scene.Scene.Handedness,
            file.Scene.Sum(static model => model.VertexCount),
            file.Scene.Sum(static model => model.FaceCount),
            file.Scene.Sum(static model => model.InstanceCount),
            file.Scene.Sum(model => distinctCounts[model]),
            file.Scene.Bounds,
            file.StorageBytes,
            loadTime,
            prepareTime);
    }

    /// <summary>Formats the summary as one JSON object, in which numbers of any length are written out.</summary>
    public string ToJson() => "{" + string.Join(", ", Fields(FormatJson).Select(field => $"\"{field.Name}\": {field.Value}")) + "}";

    /// <summary>Formats the summary as text with one field per line.</summary>
    public string ToText() => string.Join('\n', Fields(FormatPlain).Select(field => $"{field.Name,-20}{field.Value}"));

    private IEnumerable<(string Name, string Value)> Fields(Func<object?, string> format) =>
    [
        ("kind", format(Kind)),
        ("handed", format(Handedness.ToString().ToLowerInvariant())),
        ("vertices", FormatCount(Vertices, format)),
        ("faces", FormatCount(Faces, format)),
        ("instances", FormatCount(Instances, format)),
        ("infinite", format(Instances is null)),
        ("distinctInstances", DistinctInstances is { } distinct ? DecimalText.Format(distinct) : format(null)),
        ("boundsMin", format(Bounds.IsEmpty ? null : Bounds.Minimum)),
        ("boundsMax", format(Bounds.IsEmpty ? null : Bounds.Maximum)),
        ("storageBytes", format(StorageBytes)),
        ("loadMilliseconds", FormatTime(LoadTime, format)),
        ("prepareMilliseconds", FormatTime(PrepareTime, format)),
    ];

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
        Vector(var x, var y, var z) => $"[{JsonSerializer.Serialize(x)}, {JsonSerializer.Serialize(y)}, {JsonSerializer.Serialize(z)}]",
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

    private static BigInteger? CountDistinctInstances(Model model) => model switch
    {
        FractalModel { Fractal: var fractal } => Core.Fractals.DistinctInstances.Count(fractal),
        _ => BigInteger.One,
    };
}
