using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Tests.Physics.Rows;

/// <summary>What a contact has only where it was given it.</summary>
public sealed class ContactRowTests
{
    [Fact]
    public void Arms_AreNoneBeforeTheyAreSet()
    {
        var row = new ContactRow { TurnShift = Vector.I };
        Assert.Equal((false, Vector.Zero, Vector.Zero, Vector.Zero), (row.HasArms, row.FirstArm, row.SecondArm, row.TurnShift));
        row.SetArms(new(1, 2, 3), new(4, 5, 6));
        Assert.Equal((true, new(1, 2, 3), new(4, 5, 6), Vector.Zero), (row.HasArms, row.FirstArm, row.SecondArm, row.TurnShift));
        row.TurnShift = Vector.K;
        Assert.Equal(Vector.K, row.TurnShift);
        row.SetArms(Vector.I, Vector.J);
        Assert.Equal(Vector.Zero, row.TurnShift);
        ContactRow.Clear(ref row);
        Assert.Equal((false, Vector.Zero, Vector.Zero), (row.HasArms, row.FirstArm, row.SecondArm));
    }

    [Fact]
    public void TurnImpulse_OfWhatIsNotSlowedDown_IsNone()
    {
        var row = new ContactRow { TurnImpulse = Vector.I };
        Assert.Equal((false, Vector.Zero), (row.IsSlowedDown, row.TurnImpulse));
        row.RollingArm = 0.5;
        row.TurnImpulse = Vector.J;
        Assert.Equal((true, Vector.J), (row.IsSlowedDown, row.TurnImpulse));
        row.RollingArm = 0;
        row.SpinningArm = 0.5;
        Assert.Equal((true, Vector.J), (row.IsSlowedDown, row.TurnImpulse));
    }

    [Theory]
    [InlineData(-1, true, false, true)]
    [InlineData(-1, false, true, true)]
    [InlineData(-1, false, false, false)]
    [InlineData(0, true, true, false)]
    public void IsOnMovingSurface_OfASurface_TellsWhetherItMovesOrTurns(int second, bool moves, bool turns, bool isMoving)
    {
        var row = new ContactRow { Second = second };
        Assert.False(row.IsOnMovingSurface);
        row.SetSurface(moves ? Vector.I : Vector.Zero, turns ? Vector.J : Vector.Zero);
        Assert.Equal(isMoving, row.IsOnMovingSurface);
        Assert.Equal((moves ? Vector.I : Vector.Zero, turns ? Vector.J : Vector.Zero), (row.SurfaceVelocity, row.SurfaceSpin));
        ContactRow.Clear(ref row);
        Assert.Equal((Vector.Zero, Vector.Zero), (row.SurfaceVelocity, row.SurfaceSpin));
    }

    [Theory]
    [InlineData(0.5, true, false, true)]
    [InlineData(0.5, false, true, true)]
    [InlineData(0.5, false, false, false)]
    [InlineData(0, true, true, false)]
    public void MayRebound_OfWhatPushes_IsTrueAheadAndOnWhatMoves(double impulse, bool isAhead, bool moves, bool mayRebound)
    {
        var row = new ContactRow { NormalImpulse = impulse, IsAhead = isAhead };
        row.SetSurface(moves ? Vector.I : Vector.Zero, Vector.Zero);
        Assert.Equal(mayRebound, row.MayRebound);
    }

    [Fact]
    public void Clear_OfARowThatWasAnothers_LeavesNoneOfItsMarks()
    {
        var row = new ContactRow
        {
            IsBall = true, IsBouncingAhead = true, IsAhead = true, FeatureId = 3,
            NormalImpulse = 2, FrictionImpulse = Vector.I, First = 4,
        };
        ContactRow.Clear(ref row);
        Assert.False(row.IsBall || row.IsBouncingAhead || row.IsAhead);
        Assert.Equal((0, 0.0, Vector.Zero), (row.FeatureId, row.NormalImpulse, row.FrictionImpulse));
    }

    [Fact]
    public void Key_OfContactsThatDiffer_Differs()
    {
        var keys = (from first in new[] { 0, 1, 2, 900 }
                    from second in new[] { ContactRow.Immovable, 0, 1, 2, 900 }
                    from feature in new[] { 0, 1, 63, 64, 65, 2047 }
                    select new ContactRow { First = first, Second = second, FeatureId = feature }.Key).ToList();
        Assert.Equal(keys.Count, keys.Distinct().Count());
        var row = new ContactRow { First = 1, Second = 2, FeatureId = 64 };
        Assert.Contains(row.Key, keys);
    }
}
