using System.Globalization;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Catches what code of the program tells on the standard error stream.</summary>
/// <remarks>Its users belong to <see cref="ConsoleTests"/>.</remarks>
internal static class ErrorText
{
    /// <summary>Returns all that is written to the stream meanwhile.</summary>
    public static string Of(Action action)
    {
        var before = Console.Error;
        using var text = new StringWriter(CultureInfo.InvariantCulture);
        Console.SetError(text);
        try
        {
            action();
            return text.ToString();
        }
        finally
        {
            Console.SetError(before);
        }
    }
}
