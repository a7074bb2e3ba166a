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
        var collider = SharedOptions.Collider("How to search; exact unless stated.");
        var within = NumberOption("--within", "Look no farther than so many units.", "R");
        var epsilon = NumberOption("--epsilon", "Let answers be farther than the nearest by up to the factor 1 + E.", "E");
        var json = new Option<bool>("--json") { Description = "Write an array of JSON objects instead of lines." };
        var command = new Command("query", "Find the point of a file's surface nearest to each of many positions.") { points, collider, within, epsilon, json };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetRequiredValue(points),
            result.GetValue(collider) ?? ColliderKind.Exact, result.GetValue(within) ?? double.PositiveInfinity,
            result.GetValue(epsilon) ?? 0, result.GetValue(json)));
        return command;
    }

    private static Option<double?> NumberOption(string name, string description, string helpName) => new(name)
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
        string path, LoadOptions options, string pointsPath, ColliderKind kind, double within, double epsilon, bool json)
    {
        var file = Loading.Load(path, options);
        var points = PointsParser.Parse(SourceText.Read(pointsPath, pointsPath, ParsingLimits.ObjBytes));
        var clock = Stopwatch.StartNew();
        var collider = Build(file, kind);
        var buildTime = clock.Elapsed;
        clock.Restart();
        var (answers, record) = (new BatchAnswer[points.Length], new QueryRecord());
        BatchQuery.FindClosest(collider, points.AsMemory(), answers, record, within, epsilon);
        Report(file, collider, points.Length, record, buildTime, clock.Elapsed);
        Console.Out.Write(Text(answers, json));
        return ExitCode.Done;
    }

    private static SceneCollider Build(LoadedFile file, ColliderKind kind)
    {
        try
        {
            var collider = new SceneCollider(file.Scene, kind);
            collider.Build();
            return collider;
        }
        catch (ColliderMismatchException exception)
        {
            throw new UsageException(exception.Message);
        }
    }

    private static StringBuilder Text(BatchAnswer[] answers, bool json)
    {
        var text = new StringBuilder(json ? "[" : "");
        for (var i = 0; i < answers.Length; i++)
        {
            var (isFound, closest, faceTests, _) = answers[i];
            text.Append(json && i > 0 ? ",\n" : "");
            text.Append(isFound ? Text(closest, faceTests, json) : json ? "null" : "none");
            text.Append(json ? "" : "\n");
        }

        return text.Append(json ? "]\n" : "");
    }

    private static void Report(LoadedFile file, SceneCollider collider, int count, QueryRecord record, TimeSpan buildTime, TimeSpan queryTime)
    {
        var summary = FileSummary.Of(file, TimeSpan.Zero);
        Console.Error.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"faces {(summary.Faces is { } faces ? DecimalText.Of(faces) : "infinite")}\nbuild {buildTime.TotalMilliseconds:F3} ms\nmemory {collider.StorageBytes} bytes"));
        if (count > 0)
        {
            Console.Error.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"queries {count / queryTime.TotalSeconds:F0} a second\nface tests {(double)record.FaceTests / count:F2} a query\nbound tests {(double)record.BoundTests / count:F2} a query"));
        }
    }

    private static string Text(ClosestPoint closest, long faceTests, bool json) => json
        ? string.Create(CultureInfo.InvariantCulture, $"{{\"distance\": {closest.Distance:R}, \"point\": [{Text(closest.Point, ", ")}], \"normal\": [{Text(closest.Normal, ", ")}], \"faceTests\": {faceTests}}}")
        : string.Create(CultureInfo.InvariantCulture, $"{closest.Distance:R} {Text(closest.Point)} {Text(closest.Normal)} {faceTests}");

    private static string Text(Vector vector, string separator = " ") =>
        string.Create(CultureInfo.InvariantCulture, $"{vector.X:R}{separator}{vector.Y:R}{separator}{vector.Z:R}");
}
