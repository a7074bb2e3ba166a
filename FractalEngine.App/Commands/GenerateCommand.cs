using System.CommandLine;
using System.CommandLine.Parsing;
using System.Globalization;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.App.Commands;

/// <summary>
/// <c>generate NAME --output X.obj</c>: meshes made by a program, the stand-ins for the paper's models 1 and 2 among them.
/// </summary>
internal static class GenerateCommand
{
    public static Command Create()
    {
        var name = new Argument<string>("NAME") { Description = Descriptions() };
        var output = SharedOptions.OutputOption(".obj", "The mesh to write.");
        var seed = new Option<ulong?>("--seed")
        {
            Description = "Another number gives another mesh of the same kind; 0 unless stated.",
            HelpName = "N",
            CustomParser = ParseSeed,
        };
        var faces = new Option<long?>("--faces")
        {
            Description = "How many faces the mesh shall have: exactly, or the nearest number that its shape allows.",
            HelpName = "N",
            CustomParser = SharedOptions.ParseInteger(1, MeshGenerators.MaxFaceCount),
        };
        var command = new Command("generate", "Make a mesh by program, such as stand-ins for the paper's regular models.") { name, output,
            seed, faces };
        command.SetAction(result => Run(
            result.GetRequiredValue(name), result.GetRequiredValue(output), result.GetValue(seed) ?? 0, (int?)result.GetValue(faces)));
        return command;
    }

    private static int Run(string name, string output, ulong seed, int? faces)
    {
        var generator = MeshGenerators.Find(name)
            ?? throw new UsageException($"'{name}' is nothing that can be generated, expected one of: {Names()}");
        var mesh = generator.Create(seed, faces);
        AtomicFile.Write(output, stream => ObjMeshWriter.Write(mesh, stream, name));
        Console.WriteLine(mesh.FaceCount);
        return ExitCode.Done;
    }

    private static string Names() => string.Join(", ", MeshGenerators.All.Select(generator => generator.Name));

    private static string Descriptions() => string.Join(" ", MeshGenerators.All.Select(generator => string.Create(
        CultureInfo.InvariantCulture, $"{generator.Name}: {generator.Description}; {generator.DefaultFaceCount} faces unless stated.")));

    private static ulong? ParseSeed(ArgumentResult result)
    {
        if (result.Tokens is [{ Value: var token }] && ulong.TryParse(token, NumberStyles.None, CultureInfo.InvariantCulture, out var seed))
        {
            return seed;
        }

        result.AddError($"expected a whole number from 0 to {ulong.MaxValue}");
        return null;
    }
}
