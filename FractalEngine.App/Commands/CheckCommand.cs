using System.CommandLine;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Commands;

/// <summary><c>check FILE</c></summary>
internal static class CheckCommand
{
    public static Command Create()
    {
        var shared = new SharedOptions();
        var command = new Command("check", "Parse a file and everything that it refers to, and say what is wrong.");
        shared.AddTo(command);
        command.SetAction(result => Run(result.GetRequiredValue(shared.File), shared.LoadOptions(result)));
        return command;
    }

    private static int Run(string file, LoadOptions options)
    {
        var diagnostics = AssetLoader.Check(file, options);
        foreach (var diagnostic in diagnostics)
        {
            Console.Error.WriteLine(diagnostic);
        }

        var errors = diagnostics.Where(diagnostic => diagnostic.Severity == DiagnosticSeverity.Error).ToArray();
        if (errors.Length == 0)
        {
            Console.WriteLine($"{file}: ok");
            return ExitCode.Done;
        }

        return errors.All(error => error.IsLimitExceeded) ? ExitCode.OverLimit : ExitCode.BadInput;
    }
}
