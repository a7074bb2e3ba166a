using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Someone who walks in the scene.</summary>
/// <param name="Position">Where the player's centre starts, world space.</param>
/// <param name="Radius">Of the body, scene units, positive.</param>
/// <param name="Height">From the lowest to the highest point; at least twice the radius.</param>
public sealed record Player(Vector Position, double Radius, double Height);
