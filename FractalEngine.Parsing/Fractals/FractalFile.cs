using FractalEngine.Core.Fractals;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fractals;

/// <summary>A parsed fractal file.</summary>
/// <param name="Source">The text.</param>
/// <param name="Description">What its result is.</param>
/// <param name="BaseFile">The base mesh's file, as the fractal file names it.</param>
/// <param name="BaseFileNameOffset">Where the name of the base file stands in the text, for messages about that file.</param>
/// <param name="ResultOffset">Where the result is declared, for messages about the fractal as a whole.</param>
public sealed record FractalFile(
    SourceText Source, FractalDescription Description, string BaseFile, int BaseFileNameOffset, int ResultOffset);
