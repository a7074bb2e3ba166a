using System.CommandLine;
using FractalEngine.App.Commands;
using FractalEngine.App.Shell;

namespace FractalEngine.App;

/// <summary>Parses and runs the commands, and turns each error into one message on stderr and an exit code.</summary>
internal static class CommandLine
{
    private static readonly LimitOption Limits = new();

    // A name that begins with @ is that of a file, not of a list of arguments.
    private static readonly ParserConfiguration Configuration = new() { ResponseFileTokenReplacer = null };

    /// <summary>Runs the command that the arguments name.</summary>
    /// <returns>One of <see cref="ExitCode"/>.</returns>
    public static int Run(string[] args)
    {
        var root = CreateRootCommand();
        args = WithFilesBehindDashes(args);
        if (UsageErrors.ReportUnknownCommand(root, args) is { } exitCode)
        {
            return exitCode;
        }

        var result = root.Parse(args.Contains("--version") ? ["--version"] : WithDefaultCommand(root, args), Configuration);
        return HelpText.IsRequested(result) ? Guard(() => HelpText.Print(result))
            : result.Errors.Count > 0 ? UsageErrors.Report(result)
            : Guard(() =>
            {
                Limits.Apply(result);
                return result.Invoke(new() { EnableDefaultExceptionHandler = false });
            });
    }

    private static RootCommand CreateRootCommand() => new(
        "Draw, measure and simulate fractals of any size, together with regular meshes. "
        + "Without a command, FILE or the gallery is opened in a window.")
    {
        ViewCommand.Create(), RenderCommand.Create(), AnimateCommand.Create(), InfoCommand.Create(), CountCommand.Create(),
        ExportCommand.Create(), ApproximateCommand.Create(), CheckCommand.Create(), SaveCommand.Create(), GenerateCommand.Create(),
        SkyCommand.Create(), QueryCommand.Create(), SimulateCommand.Create(), LimitsCommand.Create(), Limits,
    };

    // What stands behind "--" is no option, whatever it begins with.
    private static string[] WithFilesBehindDashes(string[] args) => Array.IndexOf(args, "--") is >= 0 and var dashes
        ? [.. args[..dashes], "--", .. args[(dashes + 1)..].Select(static name => name.Length > 1 && name[0] == '-' ? $"./{name}" : name)]
        : args;

    private static string[] WithDefaultCommand(RootCommand root, string[] args) => args switch
    {
        [var first, ..] when root.Subcommands.Any(command => command.Name == first) => args,
        ["-h" or "--help" or "-?", ..] => args,
        _ => ["view", .. args],
    };

    private static int Guard(Func<int> run)
    {
        try
        {
            return run();
        }
        catch (Exception exception)
        {
            var failure = Failure.Of(exception);
            Console.Error.WriteLine(failure.Text);
            return failure.ExitCode;
        }
    }
}
