namespace FractalEngine.Core.Distances;

/// <summary>Sums over the samples of some faces.</summary>
/// <param name="Farthest">The point that is farthest from the other surface.</param>
/// <param name="Weight">Sum of the weights.</param>
/// <param name="Distance">Distances, times the weights.</param>
/// <param name="DistanceError">Estimates of what the distances may be off, times the weights.</param>
/// <param name="Angle">Angles between the normals, radians, times the weights.</param>
internal readonly record struct SampleSums(SurfacePoint Farthest, double Weight, double Distance, double DistanceError, double Angle)
{
    public static SampleSums operator +(in SampleSums sums1, in SampleSums sums2) => new(
        SurfacePoint.Farther(sums1.Farthest, sums2.Farthest),
        sums1.Weight + sums2.Weight,
        sums1.Distance + sums2.Distance,
        sums1.DistanceError + sums2.DistanceError,
        sums1.Angle + sums2.Angle);
}
