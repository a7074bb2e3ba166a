using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.Text;
using System.Text.Json;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;
using static FractalEngine.App.Shell.StandardStreams;

namespace FractalEngine.App.Commands;

/// <summary>
/// The command <c>query FILE --points POINTS.txt</c>, which finds the closest surface point for each position of a list; or what the rays
/// of a list hit.
/// </summary>
internal static class QueryCommand
{
    // As a part of the coordinates; rounding alone leaves far less.
    private const double MaxCertainError = 1e-9;

    public static Command Create()
    {
        var shared = new SharedOptions();
        var points = SharedOptions.TextOption(
            "--points", "POINTS.txt",
            "Positions to query: three numbers per line, separated by blanks or commas; '#' starts a comment. '-' is the standard input.");
        var rays = SharedOptions.TextOption(
            "--rays", "RAYS.txt", "Rays to cast instead: origin and direction, six numbers per line. '-' is the standard input.");
        var collider = SharedOptions.ColliderOption("Collider that finds the points (default: exact).");
        var maxDistance = NumberOption.NonNegative("--within", "R", "Search radius in scene units (default: unlimited).");
        var epsilon = NumberOption.NonNegative(
            "--epsilon", "E", "Accept points farther than the closest by a factor of up to 1 + E (default: 0).");
        var errorBound = SharedOptions.Flag(
            "--error-bound", "Also print how much farther than the closest point each result may be.");
        var json = new Option<bool>("--json") { Description = "Print a JSON array instead of lines." };
        var header = new Option<bool>("--header") { Description = "Print a first line with the names of the columns." };
        var command = new DocumentedCommand(
            "query", "Find the closest point of FILE's surface for each of many positions, or what many rays hit.",
            "query assets/fractals/menger.fdo --points assets/points.txt --header",
            "query assets/fractals/tree.fdo --points - --within 2 --json")
        {
            points, rays, collider, maxDistance, epsilon, errorBound, json, header,
        };
        shared.AddTo(command);
        command.SetAction(result =>
        {
            if (result.GetValue(json) && result.GetValue(header))
            {
                throw new UsageException("--header names the columns of lines, and has no effect with --json");
            }

            var path = result.GetRequiredValue(shared.File);
            var options = shared.LoadOptions(result);
            return (result.GetValue(points), result.GetValue(rays)) switch
            {
                ({ } pointsPath, null) => Run(
                    path, options, pointsPath, result.GetValue(collider) ?? ColliderKind.Exact,
                    result.GetValue(maxDistance) ?? double.PositiveInfinity, result.GetValue(epsilon) ?? 0,
                    new(result.GetValue(json), result.GetValue(errorBound), result.GetValue(header))),
                (null, not null) when HasOptionOfPoints(result) =>
                    throw new UsageException("--collider, --within, --epsilon and --error-bound need --points"),
                (null, { } raysPath) => RayQueries.Run(
                    path, options, raysPath, result.GetValue(json), result.GetValue(header)),
                _ => throw new UsageException("expected either --points or --rays"),
            };
        });
        return command;

        bool HasOptionOfPoints(ParseResult result) => result.GetValue(collider) is not null || result.GetValue(maxDistance) is not null
            || result.GetValue(epsilon) is not null || result.GetValue(errorBound);
    }

    private static int Run(
        string path, LoadOptions options, string pointsPath, ColliderKind kind, double maxDistance, double epsilon, ResultFormat format)
    {
        StandardInput.RequireOnce(path, pointsPath);
        var file = ConsoleLoader.Load(path, options);
        var points = PointsParser.Parse(StandardInput.ReadOrFile(pointsPath, ParsingLimits.PointsBytes.Value));
        var clock = Stopwatch.StartNew();
        var collider = BuildCollider(file, kind);
        var buildTime = clock.Elapsed;
        clock.Restart();
        var context = new QueryContext();
        var results = BatchQuery.Run(points, Find, context);
        WriteReport(file, collider, points.Length, context, buildTime, clock.Elapsed);
        if (kind == ColliderKind.Exact && epsilon == 0 && !format.ErrorBound && results.Count(IsUncertain) is > 0 and var count)
        {
            WriteReportLine($"uncertain {count}: the search met its limit of work, and --error-bound prints how far it may be wrong");
        }

        var header = $"distance x y z nx ny nz faceTests{(format.ErrorBound ? " errorBound" : "")}\n";
        Console.Out.Write(FormatResults(
            results, format.Json, format.Header ? header : "",
            result => result.IsFound ? FormatLine(result.Closest, result.FaceTests, format.ErrorBound) : "none",
            result => result.IsFound ? FormatJson(file.Scene, result, format.ErrorBound, kind == ColliderKind.Exact) : "null"));
        return ExitCode.Done;

        PointResult Find(Vector position, QueryContext pointContext)
        {
            var faceTests = pointContext.Statistics.FaceTests;
            var isFound = collider.TryFindClosest(position, maxDistance, pointContext, out var closest, epsilon);
            return new(isFound, closest, pointContext.Statistics.FaceTests - faceTests, pointContext.ObjectIndex, pointContext.MeshIndex);
        }
    }

    private static bool IsUncertain(PointResult result) => result.IsFound
        && result.Closest.ErrorBound > MaxCertainError * (result.Closest.Distance + result.Closest.Point.MaxAbsComponent());

    /// <exception cref="FractalEngineException">The scene reaches beyond a limit.</exception>
    internal static void RequireReach(LoadedFile file, double limit, string quantity)
    {
        var bounds = file.Scene.Bounds;
        if (!bounds.IsEmpty && Math.Max(bounds.Minimum.MaxAbsComponent(), bounds.Maximum.MaxAbsComponent()) > limit)
        {
            throw new FractalEngineException(ErrorKind.Limit, string.Create(
                CultureInfo.InvariantCulture, $"the scene reaches beyond the limit of {limit:R} for the coordinates of {quantity}"));
        }
    }

    private static SceneCollider BuildCollider(LoadedFile file, ColliderKind kind)
    {
        RequireReach(file, Collider.MaxCoordinate, "distances");
        var collider = new SceneCollider(file.Scene, kind);
        collider.Build();
        return collider;
    }

    /// <summary>Formats the results of a list.</summary>
    /// <param name="results">One for each line of the list.</param>
    /// <param name="isJson">True for a JSON array, false for lines.</param>
    /// <param name="header">First line, with its line break, where there are lines; empty for none.</param>
    /// <param name="formatLine">Formats a result as a line, without line break.</param>
    /// <param name="formatJson">Formats a result as JSON.</param>
    internal static StringBuilder FormatResults<T>(
        IReadOnlyList<T> results, bool isJson, string header, Func<T, string> formatLine, Func<T, string> formatJson)
    {
        var text = new StringBuilder(isJson ? "[" : header);
        for (var i = 0; i < results.Count; i++)
        {
            text.Append(isJson && i > 0 ? ",\n" : "").Append(isJson ? formatJson(results[i]) : formatLine(results[i]))
                .Append(isJson ? "" : "\n");
        }

        return text.Append(isJson ? "]\n" : "");
    }

    private static string FormatJson(LoadedScene scene, in PointResult result, bool hasErrorBound, bool namesMesh)
    {
        var closest = result.Closest;
        var errorBound = hasErrorBound ? string.Create(CultureInfo.InvariantCulture, $", \"errorBound\": {closest.ErrorBound:R}") : "";
        var point = FormatVector(closest.Point, ", ");
        var normal = FormatVector(closest.Normal, ", ");
        return string.Create(
            CultureInfo.InvariantCulture,
            $"{{\"distance\": {closest.Distance:R}, \"point\": [{point}], \"normal\": [{normal}], "
            + $"\"face\": {closest.FaceIndex}, {(namesMesh ? FormatMesh(scene, result.ObjectIndex, result.MeshIndex) : "")}"
            + $"\"object\": {result.ObjectIndex}, \"faceTests\": {result.FaceTests}{errorBound}}}");
    }

    /// <summary>Names the mesh of a face as a field of JSON, where an object has several; nothing for others.</summary>
    internal static string FormatMesh(LoadedScene scene, int objectIndex, int meshIndex) =>
        scene.Objects[objectIndex].Model is { Parts.Length: > 1 } model
            ? $"\"mesh\": {JsonSerializer.Serialize(model.MeshNameAt(meshIndex))}, " : "";

    private static string FormatLine(ClosestPoint closest, long faceTests, bool hasErrorBound)
    {
        var errorBound = hasErrorBound ? string.Create(CultureInfo.InvariantCulture, $" {closest.ErrorBound:R}") : "";
        return string.Create(
            CultureInfo.InvariantCulture,
            $"{closest.Distance:R} {FormatVector(closest.Point, " ")} {FormatVector(closest.Normal, " ")} {faceTests}{errorBound}");
    }

    internal static string FormatVector(Vector vector, string separator) =>
        string.Create(CultureInfo.InvariantCulture, $"{vector.X:R}{separator}{vector.Y:R}{separator}{vector.Z:R}");

    private static void WriteReport(
        LoadedFile file, SceneCollider collider, int queryCount, QueryContext context, TimeSpan buildTime, TimeSpan queryTime)
    {
        var faces = file.Scene.Sum(static model => model.FaceCount) is { } count ? DecimalText.Format(count) : "infinite";
        WriteReportLine($"faces {faces}");
        WriteReportLine($"build {buildTime.TotalMilliseconds:F3} ms");
        WriteReportLine($"memory {collider.StorageBytes} bytes");
        if (queryCount > 0)
        {
            WriteReportLine($"queries {queryCount / queryTime.TotalSeconds:F0} a second");
            WriteReportLine($"face tests {(double)context.Statistics.FaceTests / queryCount:F2} a query");
            WriteReportLine($"bound tests {(double)context.Statistics.BoundTests / queryCount:F2} a query");
        }
    }

    /// <summary>What is found for one position.</summary>
    /// <param name="IsFound">False when nothing lies within the distance; then the point means nothing.</param>
    /// <param name="Closest">The closest point.</param>
    /// <param name="FaceTests">Number of faces tested for this position.</param>
    /// <param name="ObjectIndex">Index of the object in the scene.</param>
    /// <param name="MeshIndex">Index of the base mesh of the object.</param>
    private readonly record struct PointResult(bool IsFound, ClosestPoint Closest, long FaceTests, int ObjectIndex, int MeshIndex);

    /// <summary>How results are printed.</summary>
    /// <param name="Json">True for a JSON array, false for lines.</param>
    /// <param name="ErrorBound">True to print the error bound of each.</param>
    /// <param name="Header">True to print the names of the columns before lines; JSON names each value itself.</param>
    private readonly record struct ResultFormat(bool Json, bool ErrorBound, bool Header);
}
