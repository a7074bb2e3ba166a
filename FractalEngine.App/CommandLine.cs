using System.CommandLine;
using FractalEngine.App.Commands;

namespace FractalEngine.App;

/// <summary>The commands, and what becomes of their errors: one message on stderr and an exit code.</summary>
internal static class CommandLine
{
    /// <summary>Runs what the arguments ask for.</summary>
    /// <returns>The exit code.</returns>
    public static int Run(string[] args)
    {
        var root = CreateRootCommand();
        var result = root.Parse(args.Contains("--version") ? ["--version"] : WithDefaultCommand(root, args));
        if (result.Errors.Count > 0)
        {
            foreach (var message in result.Errors.Select(error => error.Message).Distinct())
            {
                Console.Error.WriteLine($"error: {message}");
            }

            Console.Error.WriteLine("Run with --help to see the commands and their options.");
            return ExitCode.WrongUsage;
        }

        return Invoke(result);
    }

    private static RootCommand CreateRootCommand()
    {
        var root = new RootCommand("FractalEngine draws fractals of any size, and regular models beside them.");
        foreach (var command in (Command[])[
            ViewCommand.Create(), RenderCommand.Create(), InfoCommand.Create(), CountCommand.Create(), ExportCommand.Create(),
            CheckCommand.Create(), SaveCommand.Create(), GenerateCommand.Create(), QueryCommand.Create(), SimulateCommand.Create()])
        {
            root.Add(command);
        }

        return root;
    }

    /// <summary>Without the name of a command, <c>view</c> is meant. Asking for help without one is about the program as a whole.</summary>
    private static string[] WithDefaultCommand(RootCommand root, string[] args) => args switch
    {
        [var first, ..] when root.Subcommands.Any(command => command.Name == first) => args,
        ["-h" or "--help" or "-?", ..] => args,
        _ => ["view", .. args],
    };

    private static int Invoke(ParseResult result)
    {
        try
        {
            return result.Invoke(new() { EnableDefaultExceptionHandler = false });
        }
        catch (Exception exception)
        {
            var failure = Failure.Of(exception);
            Console.Error.WriteLine(failure.Text);
            return failure.ExitCode;
        }
    }
}
