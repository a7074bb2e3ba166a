using System.CommandLine;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>check FILE</c>, which prints the diagnostics of a file and of all files that it refers to.</summary>
internal static class CheckCommand
{
    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var shared = new SharedOptions();
        var command = new Command("check", "Parse FILE and all files that it refers to, and print every error and warning.");
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
