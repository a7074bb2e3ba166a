using System.CommandLine;
using System.CommandLine.Help;
using System.Globalization;
using FractalEngine.App.Options;

namespace FractalEngine.App;

/// <summary>Prints the help of a command: the library's text with the program's name as it was called, and examples.</summary>
internal static class HelpText
{
    /// <summary>Returns whether a command line asks for help.</summary>
    public static bool IsRequested(ParseResult result) => result.Action is HelpAction;

    /// <summary>Prints the help of the command that the arguments name.</summary>
    /// <returns>The exit code.</returns>
    public static int Print(ParseResult result)
    {
        using var text = new StringWriter(CultureInfo.InvariantCulture);
        var exitCode = result.Invoke(new() { Output = text });
        Console.Out.Write(text.ToString().TrimEnd().Replace(
            $"  {ProgramName.Default} ", $"  {ProgramName.Current} ", StringComparison.Ordinal) + "\n");
        if (result.CommandResult.Command is DocumentedCommand { Examples: { Count: > 0 } examples })
        {
            Console.Out.Write($"\nExamples:\n{string.Concat(examples.Select(static example => $"  {ProgramName.Current} {example}\n"))}");
        }

        return exitCode;
    }
}
