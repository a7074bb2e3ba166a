using System.CommandLine;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.App.Commands;

/// <summary><c>count FILE</c>: the paper's header (§4.1.1).</summary>
internal static class CountCommand
{
    public static Command Create()
    {
        var file = SharedOptions.FileArgument("A mesh (.obj).");
        var command = new Command("count", "Write the number of faces into the head of a mesh file: '# Mesh count: N'.") { file };
        command.SetAction(result => Run(result.GetRequiredValue(file)));
        return command;
    }

    private static int Run(string path)
    {
        var file = ConsoleLoader.Load(path, new());
        if (file.Kind != FileKind.Mesh)
        {
            throw new UsageException(
                $"only meshes (.obj) have a mesh count header, and {path} is none; 'info' counts the faces of all files");
        }

        var faces = file.Scene.Objects[0].Model.Mesh.FaceCount;
        MeshCountHeader.Update(path, faces);
        Console.WriteLine(faces);
        return ExitCode.Done;
    }
}
