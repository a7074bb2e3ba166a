using System.Globalization;
using FractalEngine.App;
using FractalEngine.App.Shell;

// Numbers on the command line, in files and on the screen look the same everywhere, and messages are English.
CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
CultureInfo.DefaultThreadCurrentUICulture = CultureInfo.CurrentUICulture = CultureInfo.InvariantCulture;
StandardStreams.Install();
InterruptSignal.EndProcessOtherwise();
if (ProcessLimits.Apply() is { } reason)
{
    Console.Error.WriteLine($"error: {reason}");
    return ExitCode.OverLimit;
}

return CommandLine.Run(args);
