using Xunit.Sdk;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>An answer of the engine that is not that of all triangles.</summary>
/// <param name="kind">Which law is broken, so that smaller models break the same one.</param>
/// <param name="details">The question, the answer and what it should be.</param>
internal sealed class GraphMismatch(string kind, FormattableString details)
    : XunitException($"{kind}: {details.ToString(System.Globalization.CultureInfo.InvariantCulture)}")
{
    public string Kind => kind;

    public static void ThrowUnless(bool condition, string kind, FormattableString details)
    {
        if (!condition)
        {
            throw new GraphMismatch(kind, details);
        }
    }
}
