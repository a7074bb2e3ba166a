using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>A part that calls of recursives explain.</summary>
/// <param name="Element">The element of the part.</param>
/// <param name="Frame">The product of the maps of all calls around it, which takes the root to it.</param>
/// <param name="Rule">The index of the last call; −1 for the root.</param>
/// <param name="Recursive">The recursive that was called.</param>
/// <param name="Level">How many calls there are.</param>
internal readonly record struct CallPart(int Element, AffineMap Frame, int Rule, int Recursive, int Level);
