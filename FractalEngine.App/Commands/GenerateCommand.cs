using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Commands;

/// <summary>
/// The command <c>generate NAME --output X.obj</c>, which writes a procedural mesh, such as a substitute for the paper's model 1 or 2.
/// </summary>
internal static class GenerateCommand
{
    public static Command Create()
    {
        var name = new Argument<string>("NAME") { Description = Descriptions() };
        var output = SharedOptions.OutputOption(".obj", "Mesh to write.");
        var seed = NumberOption.Integer(
            "--seed", "N", ulong.MinValue, ulong.MaxValue, "Seed of the generator; equal seeds give equal meshes (default: 0).");
        var faces = NumberOption.Integer(
            "--faces", "N", 1, MeshGenerators.MaxFaceCount, "Number of faces, or the closest number that the shape allows.");
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "generate", "Generate a mesh, such as a substitute for one of the paper's regular models.",
            "generate terrain --seed 7 --output out/terrain.obj", "generate torus-knot --faces 20000 --output out/knot.obj")
        {
            name, output, seed, faces,
        };
        report.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(name), result.GetRequiredValue(output), result.GetValue(seed), result.GetValue(faces),
            report.Begin(result)));
        return command;
    }

    private static int Run(string name, string output, ulong? seed, int? faces, WrittenReport report)
    {
        var generator = MeshGenerators.Find(name)
            ?? throw new UsageException($"unknown mesh '{name}', expected one of: {Names()}");
        if (seed is not null && !generator.HasRandomDetails)
        {
            throw new UsageException($"the mesh '{name}' has no random details, so --seed has no effect");
        }

        var mesh = report.Measure("generate", () => generator.Create(seed ?? 0, faces));
        report.Measure("write", () => OutputFile.Write(output, stream => ObjMeshWriter.Write(mesh, stream, name)));
        if (output != StandardInput.Name)
        {
            Console.WriteLine(mesh.FaceCount);
        }

        report.Written(output, $"{mesh.FaceCount} faces");
        return ExitCode.Done;
    }

    private static string Names() => string.Join(", ", MeshGenerators.All.Select(generator => generator.Name));

    private static string Descriptions() => string.Join('\n', MeshGenerators.All.Select(generator => string.Create(
        CultureInfo.InvariantCulture, $"{generator.Name}: {generator.Description} (default: {generator.DefaultFaceCount} faces).")));
}
