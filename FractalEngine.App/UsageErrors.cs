using System.CommandLine;
using FractalEngine.App.Shell;
using FractalEngine.Core;

namespace FractalEngine.App;

/// <summary>Reports what is wrong with a command line, and proposes the nearest command or option.</summary>
internal static class UsageErrors
{
    /// <summary>Prints the errors of a command line and where to find help.</summary>
    /// <returns>The exit code.</returns>
    public static int Report(ParseResult result)
    {
        var unknownOptions = UnknownOptions(result).ToArray();
        var messages = unknownOptions.Length > 0
            ? unknownOptions.Select(option => $"unknown option '{option}'{NameSuggestion.Ask(option, OptionNames(result))}")
            : result.Errors.Select(static error => error.Message).Distinct();
        foreach (var message in messages)
        {
            Console.Error.WriteLine($"error: {DisplayText.Escape(message)}");
        }

        var command = result.CommandResult.Command is RootCommand ? "" : $" {result.CommandResult.Command.Name}";
        Console.Error.WriteLine($"Run '{ProgramName.Current}{command} --help' to see its options.");
        return ExitCode.WrongUsage;
    }

    /// <summary>Reports a first word that is neither a command nor a file, if it is one.</summary>
    /// <returns>The exit code; null where the first word may be a file.</returns>
    public static int? ReportUnknownCommand(RootCommand root, string[] args)
    {
        if (args is not [var first, ..] || !first.All(char.IsAsciiLetter) || first.Length == 0 || Path.Exists(first)
            || root.Subcommands.Any(command => command.Name == first))
        {
            return null;
        }

        var names = root.Subcommands.Select(static command => command.Name);
        Console.Error.WriteLine($"error: there is no command or file '{first}'{NameSuggestion.Ask(first, names)}");
        Console.Error.WriteLine($"Run '{ProgramName.Current} --help' to see the commands.");
        return ExitCode.WrongUsage;
    }

    // The library also complains about each value behind an unknown option, which hides the one word that is wrong.
    private static IEnumerable<string> UnknownOptions(ParseResult result)
    {
        var known = OptionNames(result).ToHashSet();
        return result.Tokens
            .TakeWhile(static token => token.Value != "--")
            .Select(static token => token.Value.Split('=')[0])
            .Where(value => value.StartsWith("--", StringComparison.Ordinal) && value.Length > 2 && !known.Contains(value))
            .Where(value => result.Errors.Any(error => error.Message.Contains(value, StringComparison.Ordinal)))
            .Distinct();
    }

    private static IEnumerable<string> OptionNames(ParseResult result) =>
        result.CommandResult.Command.Options.Concat(result.RootCommandResult.Command.Options)
            .SelectMany(static option => option.Aliases.Append(option.Name));
}
