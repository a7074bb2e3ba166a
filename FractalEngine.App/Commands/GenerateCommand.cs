using System.CommandLine;
using System.Globalization;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.App.Commands;

/// <summary>
/// The command <c>generate NAME --output X.obj</c>, which writes a procedural mesh, such as a substitute for the paper's model 1 or 2.
/// </summary>
internal static class GenerateCommand
{
    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var name = new Argument<string>("NAME") { Description = Descriptions() };
        var output = SharedOptions.OutputOption(".obj", "Mesh to write.");
        var seed = NumberOption.Integer(
            "--seed", "N", ulong.MinValue, ulong.MaxValue, "Seed of the generator; equal seeds give equal meshes (default: 0).");
        var faces = NumberOption.Integer(
            "--faces", "N", 1, MeshGenerators.MaxFaceCount, "Number of faces, or the closest number that the shape allows.");
        var command = new Command("generate", "Generate a mesh, such as a substitute for one of the paper's regular models.")
        {
            name, output, seed, faces,
        };
        command.SetAction(result => Run(
            result.GetRequiredValue(name), result.GetRequiredValue(output), result.GetValue(seed) ?? 0, result.GetValue(faces)));
        return command;
    }

    private static int Run(string name, string output, ulong seed, int? faces)
    {
        var generator = MeshGenerators.Find(name)
            ?? throw new UsageException($"unknown mesh '{name}', expected one of: {Names()}");
        var mesh = generator.Create(seed, faces);
        OutputFile.Write(output, stream => ObjMeshWriter.Write(mesh, stream, name));
        Console.WriteLine(mesh.FaceCount);
        return ExitCode.Done;
    }

    private static string Names() => string.Join(", ", MeshGenerators.All.Select(generator => generator.Name));

    private static string Descriptions() => string.Join('\n', MeshGenerators.All.Select(generator => string.Create(
        CultureInfo.InvariantCulture, $"{generator.Name}: {generator.Description} (default: {generator.DefaultFaceCount} faces).")));
}
