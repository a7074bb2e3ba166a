using System.Collections.Immutable;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Maps one after the other, the last one first. With ranges of powers it stands for all products.</summary>
internal sealed record MapProduct(ImmutableArray<MapPower> Factors);
