using Microsoft.CodeAnalysis.CSharp;

namespace FractalEngine.Mutants;

/// <summary>How sources are parsed, everywhere alike.</summary>
internal static class Parsing
{
    /// <summary>The language of the SDK that builds the engine, with the symbols of a release for .NET 10.</summary>
    public static CSharpParseOptions Options { get; } = new CSharpParseOptions(LanguageVersion.Latest)
        .WithPreprocessorSymbols("NET", "NET10_0", "NET10_0_OR_GREATER", "RELEASE", "TRACE", "OPENTK_DEBIAN");
}
