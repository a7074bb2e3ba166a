using System.CommandLine;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>count FILE</c>, which writes the face count into the head of an OBJ file (paper §4.1.1).</summary>
internal static class CountCommand
{
    public static Command Create()
    {
        var file = SharedOptions.FileArgument("A mesh (.obj).");
        var command = new DocumentedCommand(
            "count", "Write or correct the comment '# Mesh count: N' at the head of a mesh file, and print N.",
            "count out/menger.obj", "count model.obj")
        {
            file,
        };
        command.SetAction(result => Run(result.GetRequiredValue(file)));
        return command;
    }

    private static int Run(string path)
    {
        if (path == StandardInput.Name)
        {
            throw new UsageException("count corrects a file, so it can't read the standard input: expected an OBJ file");
        }

        var file = ConsoleLoader.Load(path, new());
        if (!path.EndsWith(".obj", StringComparison.OrdinalIgnoreCase))
        {
            throw new UsageException(
                $"{path} is not an OBJ file (.obj), and only these have a count at their head; use 'info' to count the faces of others");
        }

        var faces = file.Scene.Objects[0].Model.Mesh.FaceCount;
        MeshCountHeader.Update(path, faces);
        Console.WriteLine(faces);
        return ExitCode.Done;
    }
}
