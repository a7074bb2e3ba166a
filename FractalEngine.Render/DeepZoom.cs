using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Render;

/// <summary>
/// An object that the camera is so deep in that its place is told relative to a part of it, see <see cref="FractalAddress"/>.
/// </summary>
/// <param name="ObjectIndex">Its place in the scene, from 0. Nothing else is drawn.</param>
/// <param name="Roots">What drawing begins with, about the camera, in the unit of the address.</param>
/// <param name="LogUnit">The natural logarithm of that unit, in scene units.</param>
public sealed record DeepZoom(int ObjectIndex, ImmutableArray<LodRoot> Roots, double LogUnit);
