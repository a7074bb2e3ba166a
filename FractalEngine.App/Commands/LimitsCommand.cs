using System.CommandLine;
using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Physics;
using FractalEngine.Parsing;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>limits</c>, which lists all limits that <c>--limit</c> changes.</summary>
internal static class LimitsCommand
{
    /// <summary>All limits, those of fractals first.</summary>
    public static IEnumerable<Limit> All => [.. FractalLimits.All, .. ParsingLimits.All, .. PhysicsLimits.All];

    /// <summary>Creates the command, which has no arguments.</summary>
    public static Command Create()
    {
        var command = new DocumentedCommand(
            "limits", "List all limits with their values, what they count, and why they are there.",
            "limits", "limits --limit depth=1000");
        command.SetAction(static _ => Run());
        return command;
    }

    private static int Run()
    {
        foreach (var limit in All)
        {
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture, $"{limit.Name,-22}{limit.Value,13}  {limit.Subject}: {limit.Reason}"));
        }

        return ExitCode.Done;
    }
}
