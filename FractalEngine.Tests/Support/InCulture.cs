using System.Globalization;

namespace FractalEngine.Tests.Support;

/// <summary>Runs code under the culture of a user from elsewhere.</summary>
internal static class InCulture
{
    /// <summary>Cultures with decimal commas, with a dotless i, and with other digits, signs and calendar.</summary>
    public static TheoryData<string> Names { get; } = ["de-DE", "tr-TR", "ar-SA"];

    public static T Run<T>(string name, Func<T> get)
    {
        var before = CultureInfo.CurrentCulture;
        CultureInfo.CurrentCulture = new(name);
        try
        {
            return get();
        }
        finally
        {
            CultureInfo.CurrentCulture = before;
        }
    }
}
