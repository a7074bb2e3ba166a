using System.CommandLine;
using System.IO.Enumeration;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Commands;

/// <summary>
/// The command <c>check FILE…</c>, which prints the diagnostics of files and of all files that they refer to. Of a folder it checks all
/// meshes, fractals and scenes.
/// </summary>
internal static class CheckCommand
{
    private static readonly string[] Endings = [".obj", ".obj.gz", ".ply", ".stl", ".glb", ".gltf", ".fdo", ".sdo"];

    public static Command Create()
    {
        var shared = new SharedOptions();
        var files = new Argument<string[]>("FILE")
        {
            Description = "Meshes, fractals, scenes, or folders of them; '-' is the standard input.",
            Arity = ArgumentArity.OneOrMore,
            Validators =
            {
                static result =>
                {
                    if (result.Tokens.FirstOrDefault(static token => token.Value is "" or ['-', _, ..]) is { } token)
                    {
                        result.AddError(token.Value.Length == 0 ? "the name of the file is empty" : $"unknown option '{token.Value}'");
                    }
                },
            },
        };
        var command = new DocumentedCommand(
            "check", "Parse files and all files that they refer to, and print every error and warning.",
            "check scene.sdo", "check assets --allow-outside")
        {
            files, shared.AllowOutside, shared.Composition,
        };
        command.SetAction(result => Run(result.GetRequiredValue(files), shared.LoadOptions(result)));
        return command;
    }

    private static int Run(string[] paths, LoadOptions options)
    {
        var exitCodes = paths.SelectMany(FindFiles).Select(path => Check(path, options)).Distinct().ToArray();
        return exitCodes.Contains(ExitCode.BadInput) ? ExitCode.BadInput : exitCodes.Max();
    }

    private static int Check(string path, LoadOptions options)
    {
        var diagnostics = AssetLoader.Check(path, StandardInput.AddTo(options, path));
        foreach (var diagnostic in diagnostics)
        {
            Console.Error.WriteLine(diagnostic);
        }

        var errors = diagnostics.Where(diagnostic => diagnostic.Severity == DiagnosticSeverity.Error).ToArray();
        if (errors.Length == 0)
        {
            Console.WriteLine($"{path}: ok");
            return ExitCode.Done;
        }

        return errors.All(error => error.IsLimitExceeded) ? ExitCode.OverLimit : ExitCode.BadInput;
    }

    /// <summary>Returns a file itself, and the files of a folder and its folders in ordinal order.</summary>
    /// <exception cref="UsageException">The folder has no file that could be checked.</exception>
    private static IEnumerable<string> FindFiles(string path)
    {
        if (!Directory.Exists(path))
        {
            return [path];
        }

        var files = ListFiles(path)
            .Where(static file => Endings.Any(ending => file.EndsWith(ending, StringComparison.OrdinalIgnoreCase)))
            .Order(StringComparer.Ordinal)
            .ToArray();
        return files.Length > 0 ? files : throw new UsageException($"the folder {path} has no mesh, fractal or scene");
    }

    // Links to folders are not followed: two that lead to their own folder would be followed 2^40 times.
    private static string[] ListFiles(string folder)
    {
        var options = new EnumerationOptions
        {
            RecurseSubdirectories = true, IgnoreInaccessible = false, AttributesToSkip = FileAttributes.None,
        };
        try
        {
            return
            [
                .. new FileSystemEnumerable<string>(folder, static (ref FileSystemEntry entry) => entry.ToSpecifiedFullPath(), options)
                {
                    ShouldIncludePredicate = static (ref FileSystemEntry entry) => !entry.IsDirectory,
                    ShouldRecursePredicate = static (ref FileSystemEntry entry) => !entry.Attributes.HasFlag(FileAttributes.ReparsePoint),
                },
            ];
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw new SourceException(folder, $"the folder can't be read: {exception.Message}");
        }
    }
}
