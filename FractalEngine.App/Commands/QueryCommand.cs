using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Commands;

/// <summary><c>query FILE --points POINTS.txt</c></summary>
internal static class QueryCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var points = new Option<string>("--points")
        {
            Description = "The positions to ask for: three numbers a line, blanks or commas between, # starts a comment.",
            HelpName = "POINTS.txt",
            Required = true,
        };
        var collider = SharedOptions.ColliderOption("How to search; exact unless stated.");
        var maxDistance = NonNegativeOption("--within", "Look no farther than so many units.", "R");
        var epsilon = NonNegativeOption("--epsilon", "Let answers be farther than the nearest by up to the factor 1 + E.", "E");
        var json = new Option<bool>("--json") { Description = "Write an array of JSON objects instead of lines." };
        var command = new Command("query", "Find the point of a file's surface nearest to each of many positions.") { points, collider,
            maxDistance, epsilon, json };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetRequiredValue(points),
            result.GetValue(collider) ?? ColliderKind.Exact, result.GetValue(maxDistance) ?? double.PositiveInfinity,
            result.GetValue(epsilon) ?? 0, result.GetValue(json)));
        return command;
    }

    private static Option<double?> NonNegativeOption(string name, string description, string helpName) => new(name)
    {
        Description = description,
        HelpName = helpName,
        CustomParser = result =>
        {
            if (result.Tokens is [{ Value: var token }]
                && double.TryParse(token, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
                && number >= 0 && double.IsFinite(number))
            {
                return number;
            }

            result.AddError($"{name}: expected a number that is not negative");
            return null;
        },
    };

    private static int Run(
        string path, LoadOptions options, string pointsPath, ColliderKind kind, double maxDistance, double epsilon, bool json)
    {
        var file = ConsoleLoader.Load(path, options);
        var points = PointsParser.Parse(SourceText.Read(pointsPath, pointsPath, ParsingLimits.ObjBytes));
        var clock = Stopwatch.StartNew();
        var collider = BuildCollider(file, kind);
        var buildTime = clock.Elapsed;
        clock.Restart();
        var (results, context) = (new BatchResult[points.Length], new QueryContext());
        BatchQuery.FindClosest(collider, points.AsMemory(), results, context, maxDistance, epsilon);
        WriteReport(file, collider, points.Length, context, buildTime, clock.Elapsed);
        Console.Out.Write(FormatText(results, json));
        return ExitCode.Done;
    }

    private static SceneCollider BuildCollider(LoadedFile file, ColliderKind kind)
    {
        var collider = new SceneCollider(file.Scene, kind);
        collider.Build();
        return collider;
    }

    private static StringBuilder FormatText(BatchResult[] results, bool json)
    {
        var text = new StringBuilder(json ? "[" : "");
        for (var i = 0; i < results.Length; i++)
        {
            var (isFound, closest, faceTests, _) = results[i];
            text.Append(json && i > 0 ? ",\n" : "");
            text.Append(isFound ? FormatText(closest, faceTests, json) : json ? "null" : "none");
            text.Append(json ? "" : "\n");
        }

        return text.Append(json ? "]\n" : "");
    }

    private static void WriteReport(LoadedFile file, SceneCollider collider, int queryCount, QueryContext context, TimeSpan buildTime,
        TimeSpan queryTime)
    {
        var summary = FileSummary.Of(file, TimeSpan.Zero);
        Console.Error.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"faces {(summary.Faces is { } faces ? DecimalText.Format(faces) : "infinite")}\nbuild {buildTime.TotalMilliseconds:F3} ms\nmemory {collider.StorageBytes} bytes"));
        if (queryCount > 0)
        {
            Console.Error.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"queries {queryCount / queryTime.TotalSeconds:F0} a second\nface tests {(double)context.FaceTests / queryCount:F2} a query\nbound tests {(double)context.BoundTests / queryCount:F2} a query"));
        }
    }

    private static string FormatText(ClosestPoint closest, long faceTests, bool json) => json
        ? string.Create(CultureInfo.InvariantCulture,
        $"{{\"distance\": {closest.Distance:R}, \"point\": [{FormatText(closest.Point, ", ")}], \"normal\": [{FormatText(closest.Normal, ", ")}], \"faceTests\": {faceTests}}}")
        : string.Create(CultureInfo.InvariantCulture,
        $"{closest.Distance:R} {FormatText(closest.Point)} {FormatText(closest.Normal)} {faceTests}");

    private static string FormatText(Vector vector, string separator = " ") =>
        string.Create(CultureInfo.InvariantCulture, $"{vector.X:R}{separator}{vector.Y:R}{separator}{vector.Z:R}");
}
